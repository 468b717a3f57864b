// The sums that weights of luminaires can add up to. No layout's objective lies between two of
// them, so a bound between two is one at the larger of them. Plain values; any thread.
#pragma once

#include <vector>

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

namespace limits {
/// Sums that are told apart; above them those of a step between weights are taken.
inline constexpr size_t told_apart_sums = 1'000'000;
}  // namespace limits

class AttainableSums {
 public:
  /// Of the options that are not fixed, each as often as one likes.
  explicit AttainableSums(const LayoutProblem& problem);

  /// The smallest one that is not below a bound; the bound itself where weights have no step.
  double from(double bound) const;
  /// A number below a sum that no other sum lies above and below it, and that is itself none.
  double just_below(double sum) const;

 private:
  bool is_one(size_t steps) const;

  double step_ = 0;               // every sum is a multiple of it; 0 where there is none
  std::vector<char> attainable_;  // by number of steps
};

}  // namespace luxodus
