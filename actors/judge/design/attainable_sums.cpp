#include "actors/judge/design/attainable_sums.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>

namespace luxodus {

namespace {

/// Weights with a common step are integers when multiplied by this.
constexpr double parts_of_one = 1000;
/// Rounding of weights and bounds.
constexpr double attainable_rounding = 1e-6;

}  // namespace

AttainableSums::AttainableSums(const LayoutProblem& problem) {
  std::set<int64_t> weights;
  int64_t step = 0;
  for (const LayoutOption& option : problem.options) {
    const double weight = option.fixed ? 0 : parts_of_one * option.weight;
    if (weight > 1e12 || std::abs(weight - std::round(weight)) > attainable_rounding) return;
    if (const int64_t whole = std::llround(weight); whole > 0) weights.insert(whole);
    step = std::gcd(step, std::llround(weight));
  }
  if (step == 0) return;
  step_ = static_cast<double>(step) / parts_of_one;
  // From the product of the smallest and the largest weight on, every multiple of the step is a sum
  // (Schur's bound on Frobenius numbers).
  const double from_here_all =
      static_cast<double>(*weights.begin() / step) * static_cast<double>(*weights.rbegin() / step);
  const auto count = static_cast<size_t>(
      std::min(from_here_all + 1, static_cast<double>(limits::told_apart_sums)));
  attainable_.assign(count, 0);
  attainable_[0] = 1;
  for (size_t sum = 1; sum < count; ++sum)
    attainable_[sum] = std::any_of(weights.begin(), weights.end(), [&](int64_t weight) {
      const auto steps = static_cast<size_t>(weight / step);
      return steps <= sum && attainable_[sum - steps] != 0;
    });
}

double AttainableSums::from(double bound) const {
  if (!(step_ > 0) || !(bound > 0)) return bound;
  auto steps = static_cast<size_t>(std::ceil((bound - attainable_rounding) / step_));
  while (!is_one(steps)) ++steps;
  return static_cast<double>(steps) * step_;
}

double AttainableSums::just_below(double sum) const {
  constexpr double little = 1e-3;  // of a step
  if (!(step_ > 0)) return sum - std::max(sum * attainable_rounding, 1e-9);
  auto steps = static_cast<size_t>(std::max(0.0, std::round(sum / step_)));
  if (steps == 0) return -little * step_;
  do --steps;
  while (!is_one(steps));
  return (static_cast<double>(steps) + little) * step_;
}

bool AttainableSums::is_one(size_t steps) const {
  return steps >= attainable_.size() || attainable_[steps] != 0;
}

}  // namespace luxodus
