// Grids of points of calculation, with the gaps between neighbouring points: lines of points along
// a route, and square grids over an area. Minima and ratios are judged at the points and in the
// gaps (actors/judge/assess/between_points.hpp). Pure functions; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// A stretch of a line or a parallelogram between points of a grid.
struct GridGap {
  glm::dvec3 from{0}, along{0}, across{0};  // a corner, and its sides [m]; no `across` on a line
  std::array<uint32_t, 4> corners{};        // points at its corners, the last repeated
};

struct CalculationGrid {
  std::vector<glm::dvec3> places;  // on the floor or on the plane
  std::vector<GridGap> gaps;
  size_t in_bodies = 0;  // points left out, where nobody walks or works

  /// Adds another grid, without gaps between the two.
  void append(const CalculationGrid& other);
};

/// Points on one line over one leg of a route.
struct GridLeg {
  std::vector<glm::dvec3> places;
  /// On stairs, for each place, whether a riser follows before the next one; else empty.
  std::vector<char> riser_follows;

  bool is_stairs() const { return !riser_follows.empty(); }
};
/// Points on a line that is `aside_m` to the left of a route's centre line, by leg.
using GridLine = std::vector<GridLeg>;
using LineOfRoute = std::function<GridLine(double aside_m)>;

/// A line of points at most `spacing_m` apart, as `along`, straight from corner to corner.
GridLine line_along(const EscapeRoute& route, double aside_m, double spacing_m);

/// The points of these lines. `joined`: gaps are between lines as well.
CalculationGrid grid_of(const std::vector<GridLine>& lines, bool joined);

/// Lines at most `spacing_m` apart within `half_width_m` of a route's centre line.
CalculationGrid grid_within(double half_width_m, double spacing_m, const LineOfRoute& line);

/// A square grid over an area, at least `border_m` away from its edge.
CalculationGrid grid_of(const AssessedArea& area, double border_m, double spacing_m);

}  // namespace luxodus
