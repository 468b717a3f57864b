#include "runtime/messaging/payload.hpp"

#include <algorithm>
#include <bit>

namespace luxodus {

namespace {

/// Rooms kept for reuse: as many as arrive at once in a run with large payloads.
constexpr size_t kept_rooms = 32;

}  // namespace

/// Reuses the smallest kept room that is large enough; otherwise the largest kept one is replaced
/// by a new one, so that rooms do not accumulate. New ones are up to an eighth longer where the
/// limit allows it: payloads that grow little by little take a new room a few times only.
PayloadRoom RoomPool::take(size_t bytes) {
  const size_t words = std::max<size_t>((bytes + sizeof(uint64_t) - 1) / sizeof(uint64_t), 1);
  const size_t wanted = words * sizeof(uint64_t);
  const auto smaller = [](const PayloadRoom& a, const PayloadRoom& b) {
    return a.size_bytes() < b.size_bytes();
  };
  auto best = kept_.end();
  for (auto at = kept_.begin(); at != kept_.end(); ++at)
    if (at->size_bytes() >= wanted && (best == kept_.end() || smaller(*at, *best))) best = at;
  const bool fits = best != kept_.end();
  if (!fits) best = std::max_element(kept_.begin(), kept_.end(), smaller);
  if (lent_bytes_ + (fits ? best->size_bytes() : wanted) > max_bytes_) return {};
  PayloadRoom room;
  if (best != kept_.end()) {
    kept_bytes_ -= best->size_bytes();
    room = std::move(*best);
    kept_.erase(best);
  }
  if (!fits) {
    const size_t step = std::max<size_t>(std::bit_floor(words) / 8, 1);
    const size_t rounded = (words + step - 1) / step * step;
    const bool allowed = lent_bytes_ + rounded * sizeof(uint64_t) <= max_bytes_;
    room = PayloadRoom(allowed ? rounded : words);
  }
  lent_bytes_ += room.size_bytes();
  forget_kept(max_bytes_ - std::min(max_bytes_, lent_bytes_));
  return room;
}

/// Frees kept rooms until they have at most this many bytes.
void RoomPool::forget_kept(size_t bytes) {
  while (kept_bytes_ > bytes) {
    kept_bytes_ -= kept_.back().size_bytes();
    kept_.pop_back();
  }
}

void RoomPool::give_back(PayloadRoom room) {
  lent_bytes_ -= room.size_bytes();
  if (kept_.size() == kept_rooms || lent_bytes_ + kept_bytes_ + room.size_bytes() > max_bytes_)
    return;
  kept_.reserve(kept_rooms);
  kept_bytes_ += room.size_bytes();
  kept_.push_back(std::move(room));
}

}  // namespace luxodus
