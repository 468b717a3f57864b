// Points on which an assessment works: along a route's centre line and across its width, over the
// core of an area, and the places where people stand and look ahead. Pure functions; any thread.
#pragma once

#include <optional>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Floors whose heights differ by less belong to one storey: landings, ramps, stages [m].
inline constexpr double storey_m = 2;

/// Length along the centre line [m].
double length_of(const EscapeRoute& route);
/// Whether all points of its path have the same height.
bool is_level(const EscapeRoute& route);

/// Points at most `spacing_m` apart on the line `aside_m` to the left of the centre line (negative:
/// to the right), leg by leg, with the ends of each leg.
std::vector<glm::dvec3> along(const EscapeRoute& route, double aside_m, double spacing_m);

/// The parts of one of these lines that belong to one leg, with both its ends.
std::vector<glm::dvec3> along_leg(const glm::dvec3& from, const glm::dvec3& to, double aside_m,
                                  double spacing_m);

/// Number of equal pieces of a length, each at most `spacing_m` long.
int pieces_of(double length_m, double spacing_m);

/// Points at most `spacing_m` apart, across and along, within `half_width_m` of the centre line.
std::vector<glm::dvec3> within(const EscapeRoute& route, double half_width_m, double spacing_m);

/// A square grid over the box around an area, at least `border_m` away from the edges of the box.
struct AreaLattice {
  glm::dvec2 low{0}, high{0};
  int columns = 0, rows = 0;  // steps between its points; 0 where the box is too narrow
  glm::dvec2 place(int column, int row) const {
    return low + (high - low) * glm::dvec2(static_cast<double>(column) / columns,
                                           static_cast<double>(row) / rows);
  }
};
AreaLattice lattice_of(const AssessedArea& area, double border_m, double spacing_m);

/// Points of this grid in the area, at least `border_m` away from its edge.
std::vector<glm::dvec3> within(const AssessedArea& area, double border_m, double spacing_m);
/// Whether a place lies in an area, at least `border_m` away from its edge.
bool is_within(const AssessedArea& area, const glm::dvec2& place, double border_m);

/// The box around an area, seen from above [m].
struct PlanBox {
  glm::dvec2 low{0}, high{0};
  glm::dvec2 size() const { return high - low; }
};
PlanBox plan_box_of(const AssessedArea& area);

/// A person on an escape route.
struct Walker {
  glm::dvec3 foot;   // on the floor
  glm::dvec3 ahead;  // unit vector along the route
  double along_m = 0;
};
/// Walkers at most `spacing_m` apart, from the start to the end of the route.
std::vector<Walker> walkers(const EscapeRoute& route, double spacing_m);

/// Point of the centre line at this distance from the start; beyond the end, on the extension of
/// the last leg.
glm::dvec3 place_along(const EscapeRoute& route, double along_m);

/// Whether a place lies over a route or an area, or on its edge, seen from above.
bool in_plan_of(const EscapeRoute& route, const glm::dvec2& place);
bool in_plan_of(const AssessedArea& area, const glm::dvec2& place);

/// Floor height of the nearest route or area below a place [m]; none if there is none below it.
std::optional<double> floor_below(const SceneDescription& scene, const glm::dvec3& place);

}  // namespace luxodus
