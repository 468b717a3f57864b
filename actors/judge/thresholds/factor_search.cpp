#include "actors/judge/thresholds/factor_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numeric>

namespace luxodus {

namespace {

constexpr double step_ratio = 1.25;
/// Steps that are taken at once, at most, where the limit is not bracketed yet: farther away the
/// straight line that predicts it does not hold.
constexpr int longest_stride = 6;

/// The step at a factor, not rounded; far below the ladder for clear air.
double step_at(double factor) {
  return factor > 0 ? std::log(factor) / std::log(step_ratio) : 2.0 * clear_air_step;
}

}  // namespace

double factor_of_step(int step) {
  return step == clear_air_step ? 0 : std::pow(step_ratio, step);
}

std::optional<FactorSearch::Known> FactorSearch::bracket() const {
  std::optional<Known> best;
  for (auto at = known_.begin(); std::next(at) != known_.end(); ++at) {
    if (at->second.holds() == std::next(at)->second.holds()) continue;
    if (!best || std::abs(at->first) < std::abs((*best)->first)) best = at;
  }
  return best;
}

std::optional<int> FactorSearch::next() const {
  if (const auto low = bracket()) {
    const auto high = std::next(*low);
    const int below = (*low)->first, above = high->first;
    if (above - below == 1) return std::nullopt;
    double guess = (below + above) / 2.0;
    if ((*low)->second.possible && high->second.possible)
      guess = step_at(line_crosses((*low)->second, high->second).value_or(0));
    return std::clamp(static_cast<int>(std::lround(guess)), below + 1, above - 1);
  }
  const bool up = known_.begin()->second.holds();
  const auto end = up ? std::prev(known_.end()) : known_.begin();
  if (end->first == (up ? densest_step : clear_air_step)) return std::nullopt;
  const int nearest = end->first + (up ? 1 : -1);
  const int farthest = std::clamp(end->first + (up ? longest_stride : -longest_stride),
                                  clear_air_step, densest_step);
  if (known_.size() < 2) return std::midpoint(nearest, farthest);
  const auto inner = up ? std::prev(end) : std::next(end);
  const auto guess = line_crosses(end->second, inner->second);
  if (!guess) return farthest;
  const double step = step_at(*guess);
  const int beyond =
      static_cast<int>(std::clamp(up ? std::ceil(step) : std::floor(step), -99.0, 99.0));
  return up ? std::clamp(beyond, nearest, farthest) : std::clamp(beyond, farthest, nearest);
}

std::optional<Crossing> FactorSearch::found() const {
  const auto low = bracket();
  if (!low) return std::nullopt;
  std::vector<LevelPoint> around{(*low)->second, std::next(*low)->second};
  if (*low != known_.begin()) around.insert(around.begin(), std::prev(*low)->second);
  if (std::next(*low, 2) != known_.end()) around.push_back(std::next(*low, 2)->second);
  for (const Crossing& crossing : crossings(around))
    if (crossing.at.value >= (*low)->second.at && crossing.at.value <= std::next(*low)->second.at)
      return crossing;
  return std::nullopt;
}

}  // namespace luxodus
