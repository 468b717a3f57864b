// What is read and seen of signs from a grid of places at eye height, at several times: estimates
// (sign_estimates.hpp) as a table. Plain values; make_map runs on one thread, which has rows and
// batches traced by others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/judge/visibility_map/sign_estimates.hpp"

namespace luxodus {

namespace limits {
/// Places times heights times times of a map; these times signs, also those of another program;
/// directions of view.
inline constexpr size_t map_rows = 5'000'000, map_cells = 400'000'000, map_facings = 36;
}  // namespace limits

/// Square cells; a place is the centre of a cell.
struct MapGrid {
  glm::dvec2 low{0};  // corner of the first cell [m]
  double spacing_m = 0.25;
  size_t columns = 0, rows = 0;  // along x and y

  size_t places() const { return columns * rows; }
  double x(size_t column) const { return low.x + (static_cast<double>(column) + 0.5) * spacing_m; }
  double y(size_t row) const { return low.y + (static_cast<double>(row) + 0.5) * spacing_m; }
};

struct MapRequest {
  EstimateRequest estimates;  // its eyes are those of the map
  double spacing_m = 0.25;
  std::vector<double> heights_m;    // of eyes above the floor; empty: those of the assessment
  std::optional<double> floor_m;    // none: the lowest floor of a route or area
  std::vector<double> facings_deg;  // directions of view, from +y clockwise
  /// Two corners seen from above; none: the box around the building.
  std::optional<std::pair<glm::dvec2, glm::dvec2>> box;
  size_t evac_signs = 0;  // of the files for another program
};

struct VisibilityMap {
  std::string scene, scenario;
  MapGrid grid;
  double floor_m = 0;
  std::vector<double> heights_m, facings_deg;
  std::vector<double> times_s;  // empty: the scene does not change in time
  std::vector<std::string> signs;
  std::vector<glm::dvec3> sign_places;
  std::vector<SignAnswer> answers;  // [height][time][sign][row][column]
  std::vector<char> surely_seen;    // likewise
  double sure_errors = 0;           // the largest of all states
  size_t supports = 0;              // of all states
  size_t lost_supports = 0;         // of these, as SignsInState::lost_supports
  int64_t paths = 0;

  size_t states() const { return std::max<size_t>(1, times_s.size()); }
  /// Index of the first cell of a sign's table.
  size_t table(size_t height, size_t state, size_t sign) const {
    return ((height * states() + state) * signs.size() + sign) * grid.places();
  }
};

/// Whether a sign is within guiding_angle_deg of a direction of view, both seen from above; a sign
/// straight above or below the eye is. `facing_deg`: from +y clockwise.
bool is_in_view(double facing_deg, const glm::dvec2& place, const glm::dvec3& sign);

/// Errors: as SignEstimates::make; no floor that is known; an eye height that comes twice; a map
/// larger than the limits.
Result<VisibilityMap> make_map(const MapRequest& request, const std::atomic<bool>& interrupt,
                               const AssessProgress& progress);

}  // namespace luxodus
