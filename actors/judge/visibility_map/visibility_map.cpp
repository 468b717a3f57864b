#include "actors/judge/visibility_map/visibility_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "actors/judge/visibility_map/signs_in_state.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

namespace {

/// A sign this near to the eye, seen from above, is straight above it [m].
constexpr double straight_above_m = 1e-6;

Result<double> floor_of(const MapRequest& request, const SceneDescription& scene) {
  if (request.floor_m) return *request.floor_m;
  double lowest = std::numeric_limits<double>::infinity();
  for (const EscapeRoute& route : scene.routes)
    for (const glm::dvec3& point : route.path) lowest = std::min(lowest, point.z);
  for (const AssessedArea& area : scene.open_areas) lowest = std::min(lowest, area.z_m);
  if (std::isfinite(lowest)) return lowest;
  return problem_in(scene.file,
                    "no route and no open area says where the floor of the map is: give "
                    "--map-floor");
}

/// Errors: heights that are the same in the names of files; more rows or cells than the limits.
Result<void> check_size(const MapRequest& request, const SceneDescription& scene,
                        const VisibilityMap& map) {
  std::set<std::string> names;
  for (const double height : map.heights_m)
    if (const std::string name = fmt::format("{:g}", height); !names.insert(name).second)
      return problem_in(scene.file, "the eye height " + name + " m of the map comes twice");
  const size_t rows = map.grid.places() * map.heights_m.size() * map.states();
  const size_t signs = std::max(map.signs.size(), request.evac_signs);
  const bool fits = rows <= limits::map_rows && rows * signs <= limits::map_cells;
  if (fits) return {};
  return problem_in(
      scene.file,
      fmt::format("a spacing of {:g} m gives {} by {} places, for {} eye heights, {} times and {} "
                  "signs: a map has at most {} places, heights and times, and {} cells. Take a "
                  "larger --map-spacing, a smaller --map-box, or fewer times",
                  request.spacing_m, map.grid.columns, map.grid.rows, map.heights_m.size(),
                  map.states(), signs, limits::map_rows, limits::map_cells));
}

/// Errors: as compile_scene; an empty box.
Result<MapGrid> grid_of(const MapRequest& request, const SceneDescription& scene,
                        const Scenario& scenario) {
  glm::dvec2 low, high;
  if (request.box) {
    low = glm::min(request.box->first, request.box->second);
    high = glm::max(request.box->first, request.box->second);
  } else {
    const auto compiled = compile_scene(
        std::make_shared<SceneDescription>(without_measurements(scene)), scenario, {});
    if (!compiled) return compiled.problem();
    low = glm::dvec2(compiled.value()->bounds.low);
    high = glm::dvec2(compiled.value()->bounds.high);
  }
  const glm::dvec2 size = high - low;
  if (!(size.x > 0 && size.y > 0))
    return problem_in(scene.file, "the box of the map is empty: give --map-box X0,Y0,X1,Y1");
  // The cells cover the box; it lies in their middle.
  const glm::dvec2 count = glm::ceil(size / request.spacing_m - 1e-9);
  constexpr double most = 1e6;
  const glm::dvec2 cells = glm::clamp(count, glm::dvec2(1), glm::dvec2(most));
  return MapGrid{0.5 * (low + high - cells * request.spacing_m), request.spacing_m,
                 static_cast<size_t>(cells.x), static_cast<size_t>(cells.y)};
}

std::vector<glm::dvec3> eyes_of(const VisibilityMap& map) {
  std::vector<glm::dvec3> out;
  for (const double height : map.heights_m)
    for (size_t row = 0; row < map.grid.rows; ++row)
      for (size_t column = 0; column < map.grid.columns; ++column)
        out.emplace_back(map.grid.x(column), map.grid.y(row), map.floor_m + height);
  return out;
}

void take_state(size_t number, const SignsInState& state, VisibilityMap& map) {
  const size_t places = map.grid.places();
  for (size_t height = 0; height < map.heights_m.size(); ++height)
    for (size_t sign = 0; sign < map.signs.size(); ++sign) {
      const size_t first = map.table(height, number, sign);
      for (size_t place = 0; place < places; ++place) {
        const SignEstimate& estimate =
            state.estimates()[(height * places + place) * map.signs.size() + sign];
        map.answers[first + place] = estimate.answer;
        map.surely_seen[first + place] = estimate.surely_seen ? 1 : 0;
      }
    }
  map.sure_errors = std::max(map.sure_errors, state.sure_errors());
  map.supports += state.supports();
  map.lost_supports += state.lost_supports();
  map.paths += state.paths();
}

}  // namespace

bool is_in_view(double facing_deg, const glm::dvec2& place, const glm::dvec3& sign) {
  const glm::dvec2 to = glm::dvec2(sign) - place;
  const double distance = glm::length(to);
  if (distance < straight_above_m) return true;
  const double facing = facing_deg * std::numbers::pi / 180;
  const glm::dvec2 ahead(std::sin(facing), std::cos(facing));
  return glm::dot(to, ahead) / distance >=
         std::cos(guiding_angle_deg * std::numbers::pi / 180) - 1e-12;
}

Result<VisibilityMap> make_map(const MapRequest& request, const std::atomic<bool>& interrupt,
                               const AssessProgress& progress) {
  const SceneDescription& scene = *request.estimates.states.last;
  const auto scenario = judged_scenario(scene, request.estimates.options.scenario);
  if (!scenario) return scenario.problem();
  const auto floor = floor_of(request, scene);
  if (!floor) return floor.problem();
  const auto signs = signs_named(scene, request.estimates.signs);
  if (!signs) return signs.problem();
  const auto grid = grid_of(request, scene, scenario.value());
  if (!grid) return grid.problem();
  VisibilityMap out;
  out.scene = scene.name;
  out.scenario = scenario->name;
  out.grid = grid.value();
  out.floor_m = floor.value();
  out.heights_m = request.heights_m.empty() ? scene.assessment.eye_heights_m : request.heights_m;
  out.facings_deg = request.facings_deg;
  out.times_s = request.estimates.states.times_s;
  for (const uint32_t sign : signs.value()) {
    out.signs.push_back(scene.signs[sign].name);
    out.sign_places.push_back(scene.signs[sign].frame.origin);
  }
  if (auto ok = check_size(request, scene, out); !ok) return ok.problem();
  const size_t cells = out.table(out.heights_m.size(), 0, 0);
  out.answers.assign(cells, SignAnswer::undecided);
  out.surely_seen.assign(cells, 0);
  EstimateRequest estimates = request.estimates;
  estimates.options.scenario = scenario->name;
  estimates.eyes = eyes_of(out);
  auto ok = for_each_state(
      estimates, interrupt, progress,
      [&](size_t number, std::unique_ptr<SignsInState> state) { take_state(number, *state, out); });
  if (!ok) return ok.problem();
  return out;
}

}  // namespace luxodus
