// Reassembles messages of several chunks, in memory provided by the receiver; chunks of messages
// that nobody awaits are not kept. Chunks may arrive in any order, twice, and, for one reply, from
// several holders: an object has the same bytes everywhere. Thread rule: one node's thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "proto/messages.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

class Assembler {
 public:
  /// Requires: the longest message has `max_chunks` chunks.
  Assembler(size_t messages, size_t max_chunks);

  /// Memory of an assembler, for a memory plan; the receiver provides the memory for messages.
  static size_t memory_bytes(size_t messages, size_t max_chunks) {
    return messages * (sizeof(Slot) + (max_chunks + 63) / 64 * sizeof(uint64_t));
  }

  /// Whether a chunk of this message has arrived, so that more are expected.
  bool open(const Envelope& envelope) const { return find(envelope) != nullptr; }
  bool full() const { return free_ == 0; }
  /// Begins a message. Requires: not open, not full, room.size() >= total_bytes.
  void begin(const Envelope& envelope, std::span<std::byte> room, Nanoseconds now);

  enum class Added : uint8_t { incomplete, complete, inconsistent };
  /// Requires: open, and a chunk that fits its own envelope.
  Added add(const Envelope& envelope, std::span<const std::byte> body, Nanoseconds now);
  /// The bytes of a complete message.
  std::span<const std::byte> bytes(const Envelope& envelope) const;
  void close(const MessageId& id, Kind kind);

  struct Abandoned {
    MessageId id;
    Kind kind;
  };
  /// Makes room for a neighbour with few unfinished messages at the expense of the neighbour with
  /// the most: closes the one of its messages that has been idle longest. Closes nothing if that
  /// would leave the other fewer than `newcomer` then has.
  std::optional<Abandoned> make_room(NodeId newcomer);
  /// Closes and returns a message of which nothing has arrived since `before`; nothing if there is
  /// none.
  std::optional<Abandoned> close_idle(Nanoseconds before);

 private:
  struct Slot {
    bool used = false;
    MessageId id;
    NodeId by;  // the neighbour that sent its first chunk
    Kind kind = Kind::link;
    uint32_t chunk_bytes = 0;
    uint32_t total_bytes = 0;
    uint32_t missing = 0;
    Nanoseconds touched = 0;
    std::span<std::byte> room;
    std::vector<uint64_t> come;  // one bit per chunk
  };
  /// As it mostly is where messages are short: most calls need no look at the slots then.
  bool empty() const { return free_ == slots_.size(); }
  const Slot* find(const Envelope& envelope) const;
  Slot* find(const Envelope& envelope) {
    return const_cast<Slot*>(std::as_const(*this).find(envelope));
  }

  std::vector<Slot> slots_;
  size_t free_;
};

}  // namespace luxodus
