// Lines of equal illuminance on a floor, from the map of light of an assessment. Squares of the map
// that a wall crosses are left out: light on its two sides has nothing in common. Pure; any thread.
#pragma once

#include <array>
#include <vector>

#include "actors/results/formats/contour_lines.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// What is drawn [lx]: the limits of the codes (0.5 of open areas, 1 of routes, 5 of equipment) and
/// ten times the lowest of routes.
inline constexpr std::array<double, 4> isolux_levels{0.5, 1, 5, 10};

struct IsoluxLine {
  double lux = 0;
  ContourLine line;  // in metres of the plan
};

/// Requires: a level of a plan that check_assessment has passed.
std::vector<IsoluxLine> isolux_lines(const Json& level);

}  // namespace luxodus
