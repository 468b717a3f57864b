// Where the visibility level of a sign passes a limit, between points at which the level is known.
// Pure functions; any thread.
#pragma once

#include <optional>
#include <vector>

#include "scenes/emergency/uncertain.hpp"

namespace luxodus {

/// The level at a value of what is varied.
struct LevelPoint {
  double at = 0;
  double excess = 0;     // ln(level / limit); above 0 the limit is reached
  double error = 0;      // standard error of the excess
  bool possible = true;  // false: nothing is read, or seen, whatever the light, as of a hidden sign

  bool holds() const { return possible && excess >= 0; }
};

/// A point of a level. Requires: limit > 0.
LevelPoint level_point(double at, const Uncertain& level, double limit);
LevelPoint impossible_point(double at);

struct Crossing {
  Uncertain at;        // with its standard error, of the levels' noise and of the interpolation
  bool above = false;  // the limit is reached at larger values
};

/// All crossings, ascending. The logarithm of the level is interpolated linearly, and by a parabola
/// where a third point is near; the neighbours on both sides tell the error of that. Between a
/// point that holds and one where nothing is possible the crossing is in the middle, with the error
/// of a uniform distribution between the two. Requires: points in ascending order.
std::vector<Crossing> crossings(const std::vector<LevelPoint>& points);

/// Where a straight line through two points passes the limit; none if it is level.
std::optional<double> line_crosses(const LevelPoint& a, const LevelPoint& b);

}  // namespace luxodus
