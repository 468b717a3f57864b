// Points that represent a flame in deterministic direct light. They follow from the medium alone,
// so they are equal in every process. They form a low-discrepancy sequence (Roberts' R sequence),
// so that their mean errs by about 1/n, not by 1/sqrt(n) as random points do. Pure; any thread.
#pragma once

#include <cmath>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/light/optics/media_set.hpp"

namespace luxodus {

namespace limits {
inline constexpr int flame_points = 512;
}  // namespace limits

/// The R sequence (Roberts 2018) in three or four dimensions, one coordinate after another:
/// coordinate k of its n-th point is the fractional part of n / root^k.
class EvenNumbers {
 public:
  explicit EvenNumbers(int dimensions) : dimensions_(dimensions) {
    // Roots of x^(dimensions + 1) = x + 1.
    const double root = dimensions == 3 ? 1.2207440846057596 : 1.1673039782614187;
    for (int k = 0; k < dimensions; ++k) step_[k] = std::pow(root, -(k + 1));
  }
  double next() {
    const double x = 0.5 + static_cast<double>(point_ + 1) * step_[dimension_];
    if (++dimension_ == dimensions_) {
      dimension_ = 0;
      ++point_;
    }
    return x - std::floor(x);
  }

 private:
  int dimensions_, dimension_ = 0;
  int64_t point_ = 0;
  double step_[4] = {};
};

/// Points of equal power. Requires: the medium glows.
template <class Resolver>
std::vector<glm::vec3> flame_points(const MediaSet& media, uint32_t medium, Resolver& resolver) {
  // A point of a data set takes four numbers, each try of a body three: a first draw shows which.
  Random random(medium, RandomStream::layout);
  random.start(0);
  int draws = 0;
  media.sample_emission_point(
      static_cast<int>(medium), [&] { return ++draws, random.uniform_double(); }, resolver);
  EvenNumbers numbers(draws % 3 == 0 ? 3 : 4);
  std::vector<glm::vec3> points;
  for (int i = 0; i < limits::flame_points; ++i)
    points.push_back(media.sample_emission_point(
        static_cast<int>(medium), [&] { return numbers.next(); }, resolver));
  return points;
}

}  // namespace luxodus
