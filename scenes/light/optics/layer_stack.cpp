// Builds a stack: sorts and unites all boundaries, then enters each part in the slabs that it
// spans.
#include "scenes/light/optics/layer_stack.hpp"

#include <cmath>

namespace luxodus {

void LayerStack::build(const std::vector<Part>& parts, const std::vector<double>& sigma_t,
                       int components, int bands) {
  bounds_.assign(1, -infinity);
  std::vector<double> inner;
  for (const Part& p : parts) {
    for (const double z : {p.z_low, p.z_high}) {
      if (std::isfinite(z)) inner.push_back(z);
    }
  }
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  bounds_.insert(bounds_.end(), inner.begin(), inner.end());
  bounds_.push_back(infinity);

  const size_t slabs = bounds_.size() - 1;
  slabs_ = static_cast<int>(slabs);
  first_.assign(1, 0);
  members_.clear();
  sum_.assign(slabs * static_cast<size_t>(bands), 0.0);
  running_.assign(slabs * static_cast<size_t>(bands), 0.0);
  for (size_t s = 0; s < slabs; ++s) {
    for (const Part& p : parts) {
      if (p.z_low > bounds_[s] || p.z_high < bounds_[s + 1]) continue;
      members_.push_back(p.component);
      for (size_t b = 0; b < static_cast<size_t>(bands); ++b) {
        sum_[b * slabs + s] +=
            sigma_t[b * static_cast<size_t>(components) + static_cast<size_t>(p.component)];
      }
    }
    first_.push_back(members_.size());
  }
  for (size_t b = 0; b < static_cast<size_t>(bands); ++b) {
    for (size_t s = 2; s < slabs; ++s) {
      running_[b * slabs + s] =
          running_[b * slabs + s - 1] + sum_[b * slabs + s - 1] * (bounds_[s] - bounds_[s - 1]);
    }
  }
}

// Returns the slab, from `slab` onwards in the direction of flight, in which tau or t_max ends, or
// the one before it: all earlier boundaries are certainly passed. Going up, the boundary into slab
// k is z_low(k) with optical depth running[k]; going down it is z_high(k) = z_low(k + 1) with
// running[k + 1].
int LayerStack::skip(const double* running, int slab, double z0, double dz, double t_max,
                     double tau) const {
  const double inverse = 1 / dz;
  const bool up = dz > 0;
  const int from = slab + (up ? 0 : 1);
  const auto passed = [&](int boundary) {
    return (running[boundary] - running[from]) * inverse <= tau &&
           (bounds_[static_cast<size_t>(boundary)] - z0) * inverse <= t_max;
  };
  // `passed` holds at `from` and, once false, stays false: bisect between `from` and the last
  // boundary.
  int good = from;
  int bad = up ? slabs() : 0;
  while (std::abs(bad - good) > 1) {
    const int middle = (good + bad) / 2;
    (passed(middle) ? good : bad) = middle;
  }
  return good - (up ? 0 : 1);
}

}  // namespace luxodus
