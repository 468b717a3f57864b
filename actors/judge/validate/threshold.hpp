// Finds where a visibility level passes a limit, while the density of smoke, a distance or a
// contrast is varied. Pure but for the level that is asked for; any thread.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>

#include "actors/judge/validate/agreement.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::light {

namespace limits {
/// Levels computed for one threshold. About ten are needed; so many mean that the level jumps.
inline constexpr int threshold_steps = 40;
}  // namespace limits

/// The visibility level at a value of what is varied. Errors: as the computation of the level.
using LevelAt = std::function<Result<Uncertain>(double varied)>;

/// The crossing of a limit.
struct Crossing {
  /// Where the level equals the limit, and the standard error that follows from the level's. None:
  /// the level does not pass the limit.
  std::optional<Uncertain> at;
  bool always_above = false;  // without `at`: on which side the level stays
  double slope = 0;           // of the level's logarithm, there
};

/// The crossing as the mean of those that independent levels at the found place lead to. Its error
/// is the larger of their scatter and the error that it had: a few paths may hide how far levels
/// scatter. Requires: a crossing that was found at this limit.
Crossing refined(const Crossing& crossing, double limit, std::span<const Uncertain> others);

class ThresholdFinder {
 public:
  /// Levels are computed once for each value, also for several limits. `tolerance`: largest
  /// distance of the found value from the crossing, in units of what is varied.
  ThresholdFinder(LevelAt level, Interval searched, double tolerance)
      : level_(std::move(level)), searched_(searched), tolerance_(tolerance) {}

  /// Requires: the level rises or falls throughout the interval, and limit > 0.
  /// Errors: as the level.
  Result<Crossing> crossing(double limit);
  /// How many levels were computed.
  size_t computed() const { return known_.size(); }

 private:
  struct Point {
    double varied = 0;
    double excess = 0;  // ln(level / limit)
    double error = 0;   // of the excess
  };
  Result<Point> point(double varied, double limit);
  /// Slope of the excess between a place and the nearest known point that is far enough from it.
  std::optional<double> slope_at(const Point& place, double limit) const;

  LevelAt level_;
  Interval searched_;
  double tolerance_;
  std::map<double, Uncertain> known_;
};

}  // namespace luxodus::light
