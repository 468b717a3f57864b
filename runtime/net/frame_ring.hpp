// A FIFO queue of frames in one block of memory that is allocated at construction. A frame is
// contiguous, and its body is aligned for words. A frame is charged what it occupies, so a queue
// within its window never overflows. Thread rule: one node's thread.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "proto/messages.hpp"

namespace luxodus {

namespace limits {
/// Bytes charged per frame beside its body: the cost of holding it. Both ends use this number.
inline constexpr size_t frame_overhead_bytes = 128;
}  // namespace limits

/// Bytes of the window, and of the ring, that a frame with this body takes.
constexpr size_t frame_charge(size_t body_bytes) {
  return limits::frame_overhead_bytes + (body_bytes + 7) / 8 * 8;
}

class FrameRing {
 public:
  /// Holds frames whose charges sum to at most `window` and whose bodies have at most `max_body`
  /// [bytes].
  FrameRing(size_t window, size_t max_body);

  struct Frame {
    const Envelope& envelope;
    std::span<const std::byte> body;
  };

  bool empty() const { return count_ == 0; }
  /// Requires: room within the window, and a body within its limit.
  void push(const Envelope& envelope, std::span<const std::byte> body);
  /// Requires: not empty. Valid until pop().
  Frame front() const;
  /// Requires: not empty.
  void pop();

  size_t memory_bytes() const { return capacity_; }
  /// Memory of a ring with these limits.
  static constexpr size_t memory_bytes(size_t window, size_t max_body) {
    return window / 8 * 8 + frame_charge(max_body);
  }

 private:
  struct Record;
  Record& record_at(size_t at) const;

  size_t capacity_;
  std::unique_ptr<std::byte[]> memory_;
  size_t count_ = 0;
  size_t head_ = 0;  // offset of the oldest frame
  size_t tail_ = 0;  // offset after the newest frame
  size_t wrap_ = 0;  // end of the frames before the wrap; valid while head_ > tail_
};

}  // namespace luxodus
