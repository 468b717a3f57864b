// Messages made here that wait for the network: buffer class 0 of one kind. A message is cut into
// chunks as they are sent; its payload is shared, not copied, and released with the last chunk.
// Messages take turns chunk by chunk, so that a small one does not wait for a large one. Thread
// rule: one node's thread.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "proto/messages.hpp"

namespace luxodus {

/// Immutable bytes, and the owner that keeps them alive until they are sent.
struct SharedBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};

class Outbox {
 public:
  Outbox(size_t messages, size_t chunk_bytes);

  /// Memory of an outbox with heads of usual length, for a memory plan.
  static size_t memory_bytes(size_t messages, size_t chunk_bytes);

  bool full() const { return waiting_.size() == slots_.size(); }
  size_t size() const { return waiting_.size(); }

  /// Requires: not full. The head is copied, the payload shared.
  void add(NodeId destination, const MessageId& id, ActorPair actors,
           std::span<const std::byte> head, SharedBytes payload);

  NodeId destination(size_t n) const { return slot(n).destination; }
  /// The next chunk of the nth message: sets the envelope's fields that depend on the chunk, and
  /// returns its bytes, valid until the next call. Requires: n < size().
  std::span<const std::byte> chunk(size_t n, Envelope& envelope);
  /// That chunk was sent: the message goes behind the others, or leaves after its last chunk.
  /// Returns true if it has left.
  bool advance(size_t n);
  void drop(size_t n);

 private:
  struct Slot {
    NodeId destination;
    MessageId id;
    ActorPair actors;
    std::vector<std::byte> head;  // keeps its capacity for the next message
    SharedBytes payload;
    uint32_t chunk = 0;
  };
  Slot& slot(size_t n) { return slots_[waiting_[n]]; }
  const Slot& slot(size_t n) const { return slots_[waiting_[n]]; }

  size_t chunk_bytes_;
  std::vector<Slot> slots_;
  std::vector<size_t> free_;
  std::vector<size_t> waiting_;  // in the order of turns
  std::vector<std::byte> seam_;  // a chunk that spans head and payload
};

}  // namespace luxodus
