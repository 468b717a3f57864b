// A frame that would cross the end of the block begins at its start instead, and the rest of the
// block stays empty until the oldest frames have gone. That gap is shorter than one frame, so a
// block of one window plus one longest frame always has room.
#include "runtime/net/frame_ring.hpp"

#include <cstring>
#include <new>
#include <stdexcept>

namespace luxodus {

struct FrameRing::Record {
  Envelope envelope;
  size_t body_bytes = 0;
};

FrameRing::FrameRing(size_t window, size_t max_body)
    : capacity_(memory_bytes(window, max_body)),
      // Left uninitialised: a queue that is never used takes no physical memory.
      memory_(new std::byte[capacity_]) {
  static_assert(sizeof(Record) <= limits::frame_overhead_bytes);
  static_assert(limits::frame_overhead_bytes % alignof(Record) == 0);
}

FrameRing::Record& FrameRing::record_at(size_t at) const {
  return *std::launder(reinterpret_cast<Record*>(memory_.get() + at));
}

void FrameRing::push(const Envelope& envelope, std::span<const std::byte> body) {
  const size_t charge = frame_charge(body.size());
  const bool wrapped = count_ > 0 && tail_ <= head_;
  if (!wrapped && charge > capacity_ - tail_) {
    wrap_ = tail_;
    tail_ = 0;
    if (count_ == 0) head_ = 0;
  }
  const size_t room = (count_ > 0 && tail_ <= head_ ? head_ : capacity_) - tail_;
  if (charge > room) throw std::logic_error("a frame ring was filled beyond its window");
  new (memory_.get() + tail_) Record{envelope, body.size()};
  if (!body.empty())
    std::memcpy(memory_.get() + tail_ + limits::frame_overhead_bytes, body.data(), body.size());
  tail_ += charge;
  ++count_;
}

FrameRing::Frame FrameRing::front() const {
  const Record& record = record_at(head_);
  return {record.envelope,
          {memory_.get() + head_ + limits::frame_overhead_bytes, record.body_bytes}};
}

void FrameRing::pop() {
  head_ += frame_charge(record_at(head_).body_bytes);
  --count_;
  if (count_ == 0)
    head_ = tail_ = wrap_ = 0;
  else if (head_ == wrap_ && tail_ <= head_)
    head_ = 0;
}

}  // namespace luxodus
