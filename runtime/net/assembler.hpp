// Puts messages of several chunks together, in room that whoever waits for the message has set
// aside; what nobody waits for is not kept. Chunks may come in any order, twice, and of one reply
// from several holders: an object has the same bytes everywhere.
// Thread rule: one node's thread.
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
  /// Requires: `max_chunks` chunks are the longest message.
  Assembler(size_t messages, size_t max_chunks);

  /// What one takes, for a memory plan; the room for messages is that of whoever waits for them.
  static size_t memory_bytes(size_t messages, size_t max_chunks) {
    return messages * (sizeof(Slot) + (max_chunks + 63) / 64 * sizeof(uint64_t));
  }

  /// Whether some of this message has come, so that more of it is expected.
  bool open(const Envelope& envelope) const { return find(envelope) != nullptr; }
  bool full() const { return free_ == 0; }
  /// Begins a message. Requires: not open, not full, room.size() >= total_bytes.
  void begin(const Envelope& envelope, std::span<std::byte> room, Nanoseconds now);

  enum class Added : uint8_t { incomplete, complete, inconsistent };
  /// Requires: open, and a chunk that fits its own envelope.
  Added add(const Envelope& envelope, std::span<const std::byte> body, Nanoseconds now);
  /// The bytes of a message that is complete.
  std::span<const std::byte> bytes(const Envelope& envelope) const;
  void close(const MessageId& id, Kind kind);

  struct Abandoned {
    MessageId id;
    Kind kind;
  };
  /// Who has begun many messages makes room for who has begun few: closes, of the neighbour with
  /// the most, the one of which nothing has come for the longest. Nothing where that would leave it
  /// fewer than `newcomer` then has.
  std::optional<Abandoned> make_room(NodeId newcomer);
  /// Closes a message of which nothing has come since `before` and tells which; nothing if there
  /// is none.
  std::optional<Abandoned> close_idle(Nanoseconds before);

 private:
  struct Slot {
    bool used = false;
    MessageId id;
    NodeId by;  // the neighbour that brought its first piece
    Kind kind = Kind::link;
    uint32_t chunk_bytes = 0;
    uint32_t total_bytes = 0;
    uint32_t missing = 0;
    Nanoseconds touched = 0;
    std::span<std::byte> room;
    std::vector<uint64_t> come;  // a bit per chunk
  };
  const Slot* find(const Envelope& envelope) const;
  Slot* find(const Envelope& envelope) {
    return const_cast<Slot*>(std::as_const(*this).find(envelope));
  }

  std::vector<Slot> slots_;
  size_t free_;
};

}  // namespace luxodus
