#include "runtime/net/outbox.hpp"

#include <algorithm>
#include <cstdint>

namespace luxodus {

namespace {
/// Heads of frequent messages are shorter [bytes]; a longer one grows its slot once.
constexpr size_t usual_head_bytes = 256;
}  // namespace

Outbox::Outbox(size_t messages, size_t chunk_bytes)
    : chunk_bytes_(chunk_bytes), slots_(messages), seam_(chunk_bytes) {
  for (size_t i = 0; i < messages; ++i) {
    slots_[i].head.reserve(usual_head_bytes);
    free_.push_back(messages - 1 - i);
  }
  waiting_.reserve(messages);
}

size_t Outbox::memory_bytes(size_t messages, size_t chunk_bytes) {
  return messages * (sizeof(Slot) + usual_head_bytes + 2 * sizeof(size_t)) + chunk_bytes;
}

void Outbox::add(NodeId destination, const MessageId& id, ActorPair actors,
                 std::span<const std::byte> head, SharedBytes payload) {
  const size_t at = free_.back();
  free_.pop_back();
  Slot& slot = slots_[at];
  slot.destination = destination;
  slot.id = id;
  slot.actors = actors;
  slot.head.assign(head.begin(), head.end());
  slot.payload = std::move(payload);
  slot.chunk = 0;
  waiting_.push_back(at);
}

std::span<const std::byte> Outbox::chunk(size_t n, Envelope& envelope) {
  const Slot& s = slot(n);
  const size_t head = s.head.size();
  const size_t total = head + s.payload.bytes.size();
  const size_t begin = s.chunk * chunk_bytes_;
  const size_t end = std::min(total, begin + chunk_bytes_);
  envelope.destination = s.destination;
  envelope.id = s.id;
  envelope.actors = s.actors;
  envelope.chunk = s.chunk;
  envelope.chunk_bytes = static_cast<uint32_t>(chunk_bytes_);
  envelope.total_bytes = static_cast<uint32_t>(total);
  if (end <= head) return std::span(s.head).subspan(begin, end - begin);
  if (begin >= head) return s.payload.bytes.subspan(begin - head, end - begin);
  const auto behind =
      std::copy(s.head.begin() + static_cast<std::ptrdiff_t>(begin), s.head.end(), seam_.begin());
  std::copy_n(s.payload.bytes.begin(), end - head, behind);
  return std::span(seam_).first(end - begin);
}

bool Outbox::advance(size_t n) {
  Slot& s = slot(n);
  ++s.chunk;
  if (s.chunk * chunk_bytes_ >= s.head.size() + s.payload.bytes.size()) {
    drop(n);
    return true;
  }
  const auto turn = waiting_.begin() + static_cast<std::ptrdiff_t>(n);
  std::rotate(turn, turn + 1, waiting_.end());
  return false;
}

void Outbox::drop(size_t n) {
  slot(n).payload = {};
  free_.push_back(waiting_[n]);
  waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(n));
}

}  // namespace luxodus
