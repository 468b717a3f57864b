// Spacing tables of emergency luminaires, as manufacturers print them: how far from a wall the
// first luminaire of a row may hang, and how far apart two neighbours, so that direct light alone
// gives a level at every point of the line below them. A luminaire is a point source that hangs
// level; light of further luminaires, of walls and of ceilings is not counted. Pure functions; any
// thread. Design: spacing.cpp.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace luxodus {

namespace limits {
/// Mounting heights and levels of one table; three rows times both lives fill a page.
inline constexpr size_t spacing_heights = 100;
inline constexpr size_t spacing_levels = 20;
}  // namespace limits

/// Levels that data sheets have [lx].
inline constexpr double usual_spacing_levels[] = {0.5, 1, 5};

/// Luminous intensity [cd] in a unit direction of the luminaire's frame: -Z is down, C0 along +X,
/// C90 along +Y.
using Intensity = std::function<double(const glm::dvec3& direction)>;

/// Distances along a row [m].
struct RowSpacing {
  double to_wall_m =
      0;  // from the end of the row to the first luminaire; the smaller of both sides
  double between_m = 0;  // between two neighbours that both look the same way
};

/// A row of the table. None: the level is not even met below the luminaire.
struct SpacingRow {
  double height_m = 0;  // of the luminaire above the floor
  double level_lx = 0;
  double factor = 1;                 // on the intensity
  std::optional<RowSpacing> along;   // C0 along the row
  std::optional<RowSpacing> across;  // C0 across the row, which runs along C90
};

struct SpacingRequest {
  std::vector<double> heights_m;  // above the floor
  std::vector<double> levels_lx;
  std::vector<double> factors;  // on the intensity: 1 initially, less at the end of life
  double plane_m = 0.02;        // height of the plane that is lit, above the floor
};

/// Rows by height, then factor, then level.
/// Requires: heights above the plane; positive levels and factors.
std::vector<SpacingRow> spacing_table(const Intensity& intensity, const SpacingRequest& request);

/// Horizontal illuminance [lx] of one luminaire at a distance [m] along an azimuth C [deg],
/// `drop_m` below it: E = I cos^3(gamma) / drop^2.
double illuminance_beside(const Intensity& intensity, double c_deg, double drop_m,
                          double distance_m);

}  // namespace luxodus
