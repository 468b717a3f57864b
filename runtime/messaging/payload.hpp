// The bytes that accompany a message, as its handler gets them, and the pool of rooms that hold
// them. A room returns to its pool when the handler releases it, and the next message uses it: once
// rooms have the size of a run's messages, nothing is allocated any more. Thread rule: one node's
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "runtime/net/outbox.hpp"

namespace luxodus {

/// Memory for a payload, in words, so that its content is aligned. It is not zeroed, which would
/// take milliseconds for a large one.
class PayloadRoom {
 public:
  PayloadRoom() = default;
  explicit PayloadRoom(size_t words)
      : words_(std::make_unique_for_overwrite<uint64_t[]>(words)), count_(words) {}
  PayloadRoom(PayloadRoom&& other) noexcept { *this = std::move(other); }
  PayloadRoom& operator=(PayloadRoom&& other) noexcept {
    words_ = std::move(other.words_);
    count_ = std::exchange(other.count_, 0);
    return *this;
  }

  bool empty() const { return count_ == 0; }
  size_t size_bytes() const { return count_ * sizeof(uint64_t); }
  std::span<std::byte> bytes() { return std::as_writable_bytes(std::span(words_.get(), count_)); }

 private:
  std::unique_ptr<uint64_t[]> words_;
  size_t count_ = 0;
};

class RoomPool {
 public:
  /// Rooms that are lent, and those kept for reuse, have at most `max_bytes` together.
  explicit RoomPool(size_t max_bytes) : max_bytes_(max_bytes) {}
  RoomPool(const RoomPool&) = delete;
  RoomPool& operator=(const RoomPool&) = delete;

  /// A room of at least this many bytes; empty if the pool's limit is reached.
  PayloadRoom take(size_t bytes);
  void give_back(PayloadRoom room);

  /// Bytes of lent rooms.
  size_t lent_bytes() const { return lent_bytes_; }

 private:
  void forget_kept(size_t bytes);

  const size_t max_bytes_;
  size_t lent_bytes_ = 0;
  size_t kept_bytes_ = 0;
  std::vector<PayloadRoom> kept_;
};

/// A move-only handle to the bytes of a payload, released with it: a room of a pool, or bytes
/// shared by another actor of the node.
class Payload {
 public:
  Payload() = default;
  /// `bytes` lie in the room. Requires: `pool` outlives this.
  Payload(RoomPool& pool, PayloadRoom room, std::span<const std::byte> bytes)
      : pool_(&pool), room_(std::move(room)), bytes_(bytes) {}
  explicit Payload(SharedBytes shared) : shared_(std::move(shared)), bytes_(shared_.bytes) {}
  Payload(Payload&& other) noexcept { *this = std::move(other); }
  Payload& operator=(Payload&& other) noexcept {
    std::swap(pool_, other.pool_);
    std::swap(room_, other.room_);
    std::swap(shared_, other.shared_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Payload() {
    if (pool_ != nullptr) pool_->give_back(std::move(room_));
  }

  std::span<const std::byte> bytes() const { return bytes_; }
  /// Bytes outside the pool's rooms, and their owner.
  SharedBytes shared() && { return std::move(shared_); }

 private:
  RoomPool* pool_ = nullptr;  // null: the bytes are in no room
  PayloadRoom room_;
  SharedBytes shared_;
  std::span<const std::byte> bytes_;
};

}  // namespace luxodus
