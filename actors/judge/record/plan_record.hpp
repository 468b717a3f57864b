// Plans of a building as the record of an assessment holds them: floors with their walls, their
// illuminance, and drawings below them. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/judge/record/inputs_record.hpp"
#include "actors/judge/record/record_forms.hpp"

namespace luxodus {

namespace limits {
/// Grid points of one illuminance map.
inline constexpr size_t record_map = 1'000'000;
}  // namespace limits

/// Both ends of a line.
using DrawnLine = std::pair<glm::dvec2, glm::dvec2>;

/// A point of calculation on a plan, lit by the emergency luminaires whose circuits are on and
/// whose supply lasts at the judged time [lx].
struct PlanPoint {
  glm::dvec3 place{0};
  double lux = 0;
};

/// An illuminance with four significant digits [lx]: a map is for drawing, and its file stays
/// small. NaN where there is none.
struct DrawnLux {
  double lux = 0;
};
DrawnLux drawn_lux(double lux);

/// Direct light of the same luminaires on a grid over a floor, without furniture.
struct LightMap {
  glm::dvec2 corner{0};  // of the first grid point
  double spacing_m = 0;
  int columns = 0, rows = 0;  // along x, along y
  std::vector<DrawnLux> lux;  // row by row, columns times rows values
  static constexpr void fields(auto&& field, auto& m) {
    field("corner", m.corner)("spacing", m.spacing_m)("columns", m.columns)("rows", m.rows);
    field("lux", m.lux);
  }
};

/// One floor of the building, for its plan.
struct PlanLevel {
  double floor_m = 0;
  std::vector<DrawnLine> walls, furniture;  // sections at breast height
  std::vector<PlanPoint> points;            // of calculation on its routes and open areas
  LightMap map;
  static constexpr void fields(auto&& field, auto& m) {
    field("floor", m.floor_m)("walls", m.walls)("furniture", m.furniture)("points", m.points);
    field("map", m.map);
  }
};

/// Points of calculation of one kind on a surface, with their statistics [lx].
struct SurfaceGridRecord {
  std::string kind;  // "centre", "band" of a route; "area"
  std::vector<PlanPoint> points;
  double least = 0, mean = 0, most = 0;
  glm::dvec3 darkest{0}, brightest{0};
  static constexpr void fields(auto&& field, auto& m) {
    field("kind", m.kind)("points", m.points);
    field("least", m.least, {.unit = "lx"})("mean", m.mean, {.unit = "lx"});
    field("most", m.most, {.unit = "lx"})("darkest", m.darkest)("brightest", m.brightest);
  }
};

/// A route, an open area or a task area, lit as PlanPoint says, without furniture.
struct SurfaceRecord {
  Subject subject;
  std::vector<SurfaceGridRecord> grids;  // at least one; none has no points
  size_t in_bodies = 0;                  // points left out, in bodies
  LightMap map;                          // of a plane above the floor, else empty
  static constexpr void fields(auto&& field, auto& m) {
    field("subject", m.subject)("grids", m.grids)("in_bodies", m.in_bodies)("map", m.map);
  }
};

/// A drawing under plans: lines, or a picture with its place.
struct BackdropRecord {
  glm::dvec2 floors{0};  // from and to which height it belongs to a floor
  std::optional<glm::dvec2> corner, across, up;
  std::string png;  // base64
  std::optional<std::vector<DrawnLine>> lines;
  static constexpr void fields(auto&& field, auto& m) {
    field("floors", m.floors)("corner", m.corner)("across", m.across)("up", m.up);
    field("png", m.png, {.or_left_out = true, .max_text = limits::record_picture});
    field("lines", m.lines);
  }
};

struct PlanRecord {
  std::vector<PlanLevel> levels;  // from below; at least one
  double route_grid_m = 0, area_grid_m = 0, height_m = 0;
  std::vector<BackdropRecord> backdrops;
  static constexpr void fields(auto&& field, auto& m) {
    field("levels", m.levels);
    field("route_grid", m.route_grid_m, {.unit = "m"})("area_grid", m.area_grid_m, {.unit = "m"});
    field("height", m.height_m, {.unit = "m"});
    field("backdrops", m.backdrops, {.or_left_out = true});
  }
};

/// Drawings under plans alone, as a plan has them.
Json backdrops_json(const std::vector<BackdropRecord>& backdrops);

}  // namespace luxodus
