// The sums that weights of luminaires can form. No objective lies between two neighbouring sums, so
// a lower bound can be raised to the next sum. Plain values; any thread.
#pragma once

#include <vector>

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

namespace limits {
/// Number of sums that are enumerated; above them every multiple of the step counts as a sum.
inline constexpr size_t told_apart_sums = 1'000'000;
}  // namespace limits

class AttainableSums {
 public:
  /// Sums of weights of the options that are not fixed, each any number of times.
  explicit AttainableSums(const LayoutProblem& problem);

  /// The smallest sum that is not below a bound; the bound itself if the weights have no common
  /// step.
  double from(double bound) const;
  /// A number below `sum` and above the next smaller sum.
  double just_below(double sum) const;

 private:
  bool is_one(size_t steps) const;

  double step_ = 0;               // every sum is a multiple of it; 0 if there is none
  std::vector<char> attainable_;  // by number of steps
};

}  // namespace luxodus
