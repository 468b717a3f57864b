// Where an assessment looks: points along a route's centre line and across its width, over the core
// of an area, and the places where people stand and look ahead. Pure functions; any thread.
#pragma once

#include <optional>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Length along the centre line [m].
double length_of(const EscapeRoute& route);
/// Whether all of it is at one height.
bool is_level(const EscapeRoute& route);

/// Points at most `spacing_m` apart on the line that runs `aside_m` to the left of the centre line
/// (negative: to the right), leg by leg, ends included.
std::vector<glm::dvec3> along(const EscapeRoute& route, double aside_m, double spacing_m);

/// Points at most `spacing_m` apart, across and along, within `half_width_m` of the centre line.
std::vector<glm::dvec3> within(const EscapeRoute& route, double half_width_m, double spacing_m);

/// Points of a square grid over an area that lie `border_m` or more from its edge.
std::vector<glm::dvec3> within(const AssessedArea& area, double border_m, double spacing_m);

/// Somebody on the way out.
struct Walker {
  glm::dvec3 foot;   // on the floor
  glm::dvec3 ahead;  // unit vector along the route
  double along_m = 0;
};
/// At most `spacing_m` apart, from the start to the end of the route.
std::vector<Walker> walkers(const EscapeRoute& route, double spacing_m);

/// Where on the centre line somebody is who has come so far; beyond its end, straight ahead of the
/// last leg.
glm::dvec3 place_along(const EscapeRoute& route, double along_m);

/// Whether a place lies over a route or an area, or on its edge, seen from above.
bool in_plan_of(const EscapeRoute& route, const glm::dvec2& place);
bool in_plan_of(const AssessedArea& area, const glm::dvec2& place);

/// Where the floor of the nearest route or area is that lies below a place [m]; none where there is
/// none of them.
std::optional<double> floor_below(const SceneDescription& scene, const glm::dvec3& place);

}  // namespace luxodus
