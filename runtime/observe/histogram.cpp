#include "runtime/observe/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {

size_t Histogram::bin_of(Nanoseconds duration) {
  if (duration < lowest) return 0;
  size_t decade = 0;
  Nanoseconds width = lowest / 10;
  while (duration >= 100 * width) {
    if (++decade == decades) return bins - 1;
    width *= 10;
  }
  return 1 + decade * bins_per_decade + static_cast<size_t>(duration / width) - 10;
}

Nanoseconds Histogram::end_of(size_t bin) {
  if (bin == 0) return lowest;
  if (bin == bins - 1) return std::numeric_limits<Nanoseconds>::max();
  Nanoseconds width = lowest / 10;
  for (size_t decade = (bin - 1) / bins_per_decade; decade > 0; --decade) width *= 10;
  return static_cast<Nanoseconds>((bin - 1) % bins_per_decade + 11) * width;
}

void Histogram::add(Nanoseconds duration) {
  const Nanoseconds taken = std::max<Nanoseconds>(duration, 0);
  least_ = count_ == 0 ? taken : std::min(least_, taken);
  most_ = std::max(most_, taken);
  sum_ += taken;
  ++count_;
  ++counts_[bin_of(taken)];
}

void Histogram::merge(const Histogram& other) {
  if (other.count_ == 0) return;
  least_ = count_ == 0 ? other.least_ : std::min(least_, other.least_);
  most_ = std::max(most_, other.most_);
  sum_ += other.sum_;
  count_ += other.count_;
  for (size_t i = 0; i < bins; ++i) counts_[i] += other.counts_[i];
}

Nanoseconds Histogram::at(double quantile) const {
  const auto rank = static_cast<uint64_t>(std::ceil(quantile * static_cast<double>(count_)));
  uint64_t seen = 0;
  for (size_t bin = 0; bin < bins; ++bin) {
    seen += counts_[bin];
    if (seen >= rank && seen > 0) return std::min(end_of(bin), most_);
  }
  return most_;
}

}  // namespace luxodus
