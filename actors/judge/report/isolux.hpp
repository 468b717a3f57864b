// Lines of equal illuminance on a floor, from the illuminance map of an assessment. Squares of the
// map that a wall crosses are left out, since the light on both sides of a wall is unrelated; lines
// go on straight from there to the wall. Pure function; any thread.
#pragma once

#include <array>
#include <vector>

#include "actors/judge/record/plan_record.hpp"
#include "actors/results/formats/contour_lines.hpp"

namespace luxodus {

/// Illuminances of the lines [lx]: limits of the codes (0.5 in open areas, 1 on routes, 5 at
/// equipment) and ten times the limit on routes.
inline constexpr std::array<double, 4> isolux_levels{0.5, 1, 5, 10};

struct IsoluxLine {
  double lux = 0;
  ContourLine line;  // in plan coordinates [m]
};

/// Requires: a map with a value for each of its places, or without places.
std::vector<IsoluxLine> isolux_lines(const PlanLevel& level);

}  // namespace luxodus
