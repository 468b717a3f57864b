#include "runtime/fetch/route_delay.hpp"

#include <algorithm>
#include <bit>

namespace luxodus {

// Bin 2w + s holds delays of w significant bits [us]; s is the bit after the first.
size_t RouteDelay::bin_of(Nanoseconds delay) {
  const auto us = static_cast<uint64_t>(std::max<Nanoseconds>(delay, 0) / microseconds(1));
  const auto width = static_cast<size_t>(std::bit_width(us));
  if (width > max_powers) return bins - 1;
  const size_t second = width >= 2 ? (us >> (width - 2)) & 1 : 0;
  return 2 * width + second;
}

Nanoseconds RouteDelay::end_of(size_t bin) {
  const size_t width = bin / 2;
  if (width < 2) return microseconds(static_cast<int64_t>(width) + 1);
  const int64_t half = int64_t{1} << (width - 2);
  return microseconds(half * (bin % 2 == 0 ? 3 : 4));
}

void RouteDelay::answered(Nanoseconds delay) {
  doublings_ = 0;
  if (total_ == remembered) {
    total_ = 0;
    for (uint16_t& count : counts_) {
      count = static_cast<uint16_t>(count / 2);
      total_ += count;
    }
  }
  ++counts_[bin_of(delay)];
  ++total_;
}

void RouteDelay::timed_out(Nanoseconds asked, Nanoseconds now) {
  if (asked < doubled_at_) return;
  doubled_at_ = now;
  doublings_ = std::min(doublings_ + 1, max_doublings);
}

Nanoseconds RouteDelay::p99() const {
  uint32_t above = 0;
  for (size_t bin = bins; bin-- > 0;) {
    above += counts_[bin];
    if (above > total_ / 100) return end_of(bin);
  }
  return 0;
}

Nanoseconds RouteDelay::timeout(const TimeoutLimits& limits, unsigned nth) const {
  const Nanoseconds usual = total_ == 0 ? limits.first : std::max(limits.floor, 3 * p99());
  const unsigned doublings = std::min(std::max(doublings_, nth - 1), max_doublings);
  return std::min(std::min(usual, limits.most) << doublings, limits.most);
}

}  // namespace luxodus
