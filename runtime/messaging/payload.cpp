#include "runtime/messaging/payload.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// Kept for later: as many as come at once in a run, where they are large.
constexpr size_t kept_rooms = 32;

size_t bytes_of(const Room& room) {
  return room.capacity() * sizeof(uint64_t);
}

}  // namespace

/// The smallest kept one that is large enough; else the largest grows, so that rooms do not become
/// many.
Room RoomPool::take(size_t bytes) {
  const size_t words = (bytes + sizeof(uint64_t) - 1) / sizeof(uint64_t);
  const auto smaller = [](const Room& a, const Room& b) { return a.capacity() < b.capacity(); };
  auto best = kept_.end();
  for (auto at = kept_.begin(); at != kept_.end(); ++at)
    if (at->capacity() >= words && (best == kept_.end() || smaller(*at, *best))) best = at;
  if (best == kept_.end()) best = std::max_element(kept_.begin(), kept_.end(), smaller);
  const size_t capacity = best == kept_.end() ? 0 : best->capacity();
  if (lent_bytes_ + std::max(capacity, words) * sizeof(uint64_t) > max_bytes_) return {};
  Room room;
  if (best != kept_.end()) {
    kept_bytes_ -= bytes_of(*best);
    room = std::move(*best);
    kept_.erase(best);
  }
  room.resize(std::max<size_t>(words, 1));
  lent_bytes_ += bytes_of(room);
  forget_kept(max_bytes_ - std::min(max_bytes_, lent_bytes_));
  return room;
}

/// Until those that are kept have at most so many bytes.
void RoomPool::forget_kept(size_t bytes) {
  while (kept_bytes_ > bytes) {
    kept_bytes_ -= bytes_of(kept_.back());
    kept_.pop_back();
  }
}

void RoomPool::give_back(Room room) {
  lent_bytes_ -= bytes_of(room);
  if (kept_.size() == kept_rooms || lent_bytes_ + kept_bytes_ + bytes_of(room) > max_bytes_) return;
  kept_.reserve(kept_rooms);
  kept_bytes_ += bytes_of(room);
  kept_.push_back(std::move(room));
}

}  // namespace luxodus
