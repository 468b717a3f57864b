#include "actors/assess/code_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "actors/assess/plan_cut.hpp"
#include "scenes/transport/compile_light.hpp"
#include "scenes/transport/surroundings.hpp"

namespace luxodus {

namespace {

constexpr const char* furniture = "furniture";
constexpr double standing_eye_m = 1.65;
/// A place that lies in a wall or a door is looked from so far beside it [m].
constexpr double beside_m = 0.3;
/// So far before a luminous opening a line ends: it may lie in a ceiling [m].
constexpr double before_opening_m = 0.01;
/// Of a luminaire's largest intensity: less sent to a place is none.
constexpr double faint_share = 1e-3;
/// Panes that pass less hide a sign: clear ones pass 0.9, two of them 0.8.
constexpr double dark_pane = 0.5;
/// A floor is looked for so far below a thing, and not in the thing's own body [m].
constexpr Real deepest_m = 1000, own_body_m = 0.15_r;
/// What is met so little above a route is no floor: desks, counters [m].
constexpr double desk_m = 1.3;

bool is_furniture(const Object& object) {
  return std::count(object.tags.begin(), object.tags.end(), furniture) > 0;
}

/// A sign that is lit from within and gives no light in an emergency shows nobody the way.
bool is_dark(const Sign& sign) {
  return sign.lighting == SignLighting::internal && sign.emergency.white_cd_m2 == 0 &&
         sign.emergency.green_cd_m2 == 0;
}

/// The scene with emergency fluxes and luminances of signs as the circuits of the judged state
/// leave them, never above what is stated: a luminaire that the state has switched off lights no
/// check.
SceneDescription as_switched(const SceneDescription& scene, const Scenario& state) {
  SceneDescription out = scene;
  if (state.operation == Operation::mains) return out;
  for (Emitter& e : out.emitters)
    e.emergency_flux *= std::min(1.0, factor_of(state.circuits, e.circuit, 1));
  for (Sign& sign : out.signs) {
    if (sign.lighting != SignLighting::internal) continue;
    const double factor = std::min(1.0, factor_of(state.circuits, sign.circuit, 1));
    sign.emergency.white_cd_m2 *= factor;
    sign.emergency.green_cd_m2 *= factor;
  }
  return out;
}

/// The building as the codes look at it.
SceneDescription code_scene(const SceneDescription& scene, bool furnished) {
  SceneDescription out = without_measurements(scene);
  out.media.clear();
  std::erase_if(out.emitters, [](const Emitter& e) { return !(e.emergency_flux > 0); });
  // With no emergency luminaire the geometry is still asked for: any light will do to compile it.
  if (out.emitters.empty()) out.emitters = scene.emitters;
  if (!furnished) std::erase_if(out.objects, is_furniture);
  return out;
}

Scenario code_scenario(const SceneDescription& scene, const Scenario& doors) {
  Scenario out;
  out.name = "code mode";
  out.operation = emergency_luminaires(scene).empty() ? Operation::mains : Operation::emergency;
  out.doors_open = doors.doors_open;
  out.doors_closed = doors.doors_closed;
  return out;
}

void append(std::vector<Check>& out, const std::vector<Check>& more) {
  out.insert(out.end(), more.begin(), more.end());
}

void add_condition(std::vector<Check>& checks, const std::string& condition) {
  for (Check& check : checks) check.condition += (check.condition.empty() ? "" : "; ") + condition;
}

class CodeMode {
 public:
  CodeMode(const SceneDescription& scene, const Building& building,
           const std::vector<CodeChoice>& codes)
      : scene_(scene), building_(building), codes_(codes) {
    if (emergency_luminaires(scene).empty()) return;
    const auto& emitters = building.scene().emitters;
    for (size_t i = 0; i < emitters.size(); ++i)
      if (emitters[i].sign == none_index) columns_.push_back(i);
  }

  /// What all luminaires give at places, a little above them, on a surface that faces `normal`.
  std::vector<LitPoint> lit(const std::vector<glm::dvec3>& places, const glm::dvec3& normal,
                            double lift) const;
  /// Those that what stands in the way may change.
  std::vector<Check> checks_by_light() const;
  /// Those of signs and luminaires by themselves.
  std::vector<Check> checks_of_parts() const;
  /// The points of calculation of each level, and its map of light.
  void fill_plan(std::vector<PlanLevel>& levels) const;

 private:
  std::vector<Check> of_route(const EscapeRoute& route) const;
  std::vector<Check> of_area(
      const AssessedArea& area, double border_m,
      const std::function<std::vector<Check>(const std::vector<LitPoint>&, const CodeChoice&)>&
          checks) const;
  std::vector<std::vector<ClearSign>> clear_signs(const std::vector<Walker>& people) const;
  /// Of the light from the middle of a face to an eye, what panes on the way let pass.
  double passed_by_panes(const GeometryAccess& access, const SignView& view,
                         const glm::dvec3& eye) const;
  double lux_on_face(const Sign& sign) const;
  std::optional<double> vertical_lux(const EmphasisPoint& point) const;
  LinesOfSight seen_from(const std::vector<glm::dvec3>& places) const;
  /// Whether a luminaire sends any of its light to a place.
  bool shines_at(const GeometryAccess& access, uint32_t luminaire, const glm::dvec3& place) const;
  /// The floor that a thing hangs over: what is met below it, without furniture; a route's or an
  /// area's where that is met a little below.
  std::optional<double> floor_under(const glm::dvec3& place) const;

  const SceneDescription& scene_;
  const Building& building_;
  const std::vector<CodeChoice>& codes_;
  std::vector<size_t> columns_;  // luminaires among the compiled emitters
};

std::vector<LitPoint> CodeMode::lit(const std::vector<glm::dvec3>& places, const glm::dvec3& normal,
                                    double lift) const {
  std::vector<LitPoint> out(places.size());
  DirectOptions clear_air;
  clear_air.media = false;
  building_.each(places.size(), [&](const GeometryAccess& access, size_t i) {
    out[i].place = places[i] + normal * lift;
    const auto lux = direct_by_emitter(building_.scene(), access, building_.local(out[i].place),
                                       glm::vec3(normal), clear_air);
    for (const size_t column : columns_) out[i].lux.push_back(lux[column]);
  });
  return out;
}

std::vector<std::vector<ClearSign>> CodeMode::clear_signs(const std::vector<Walker>& people) const {
  std::vector<std::vector<ClearSign>> out(people.size());
  building_.each(people.size(), [&](const GeometryAccess& access, size_t i) {
    const glm::dvec3 eye = people[i].foot + glm::dvec3(0, 0, standing_eye_m);
    for (uint32_t s = 0; s < scene_.signs.size(); ++s) {
      if (is_dark(scene_.signs[s])) continue;
      const SignView view = view_of_sign(scene_.signs[s], eye);
      if (view.behind || building_.seen_share(access, scene_.signs[s], view, eye) <= 0.5) continue;
      const double passed = passed_by_panes(access, view, eye);
      if (passed > 0 && passed < dark_pane) continue;
      out[i].push_back({s, view, passed > 0 && passed < 1 - faint_share});
    }
  });
  return out;
}

double CodeMode::passed_by_panes(const GeometryAccess& access, const SignView& view,
                                 const glm::dvec3& eye) const {
  return clear_share(building_.scene(), access, building_.local(eye),
                     building_.local(view.centre + view.normal * 1e-3));
}

std::vector<Check> CodeMode::of_route(const EscapeRoute& route) const {
  const RoutePoints points = points_of(route);
  const glm::dvec3 up(0, 0, 1);
  RouteLight light;
  light.centre = lit(points.centre, up, floor_plane_m);
  light.band = lit(points.band, up, floor_plane_m);
  light.inner = lit(points.inner, up, floor_plane_m);
  const auto people = walkers(route, scene_.assessment.spacing_m);
  const auto clear = clear_signs(people);
  std::vector<Check> out;
  for (const CodeChoice& codes : codes_) {
    append(out, checks_of_route(scene_, route, light, codes));
    append(out, checks_of_distance(scene_, route, people, clear, codes));
  }
  out.push_back(check_of_failure(scene_, "route \"" + route.name + "\"", light.centre));
  return out;
}

double CodeMode::lux_on_face(const Sign& sign) const {
  if (sign.lighting != SignLighting::external) return 0;
  std::vector<glm::dvec3> places;
  for (const double u : {-0.25, 0.25})
    for (const double v : {-0.25, 0.25})
      places.push_back(sign.frame.origin + sign.frame.axes[0] * (u * sign.width_m) +
                       sign.frame.axes[1] * (v * sign.height_m));
  double sum = 0;
  for (const LitPoint& p : lit(places, sign.frame.axes[2], 0.002))
    for (const double lux : p.lux) sum += lux / static_cast<double>(places.size());
  return sum;
}

std::optional<double> CodeMode::vertical_lux(const EmphasisPoint& point) const {
  if (!point.facing) return std::nullopt;
  double sum = 0;
  for (const double lux : lit({point.position}, *point.facing, floor_plane_m).front().lux)
    sum += lux;
  return sum;
}

/// From any of the places.
LinesOfSight CodeMode::seen_from(const std::vector<glm::dvec3>& places) const {
  const auto luminaires = emergency_luminaires(scene_);
  std::vector<char> seen(luminaires.size(), 0);
  building_.each(luminaires.size(), [&](const GeometryAccess& access, size_t i) {
    const glm::dvec3 lamp = scene_.emitters[luminaires[i]].frame.origin;
    for (const glm::dvec3& place : places) {
      const double distance = glm::length(place - lamp);
      if (!(distance > before_opening_m)) continue;
      const glm::dvec3 before = lamp + (place - lamp) * (before_opening_m / distance);
      if (clear_share(building_.scene(), access, building_.local(place), building_.local(before)) >
              0 &&
          shines_at(access, luminaires[i], place))
        seen[i] = 1;
    }
  });
  return LinesOfSight(seen.begin(), seen.end());
}

bool CodeMode::shines_at(const GeometryAccess& access, uint32_t luminaire,
                         const glm::dvec3& place) const {
  const Emitter& e = scene_.emitters[luminaire];
  if (e.distribution == Distribution::web) {
    const glm::dvec3 local = glm::transpose(e.frame.axes) * glm::normalize(place - e.frame.origin);
    return e.web->intensity(local) > faint_share * e.web->peak_cd();
  }
  // Of simple shapes by what falls on a face that is turned to them.
  const auto luminaires = emergency_luminaires(scene_);
  const auto at = std::find(luminaires.begin(), luminaires.end(), luminaire);
  const auto column = static_cast<size_t>(at - luminaires.begin());
  if (column >= columns_.size()) return true;
  DirectOptions clear_air;
  clear_air.media = false;
  const auto lux = direct_by_emitter(building_.scene(), access, building_.local(place),
                                     glm::vec3(glm::normalize(e.frame.origin - place)), clear_air);
  return lux[columns_[column]] > 0;
}

std::optional<double> CodeMode::floor_under(const glm::dvec3& place) const {
  const auto stated = floor_below(scene_, place);
  std::optional<double> met;
  building_.each(1, [&](const GeometryAccess& access, size_t) {
    const auto stop =
        first_stop(building_.scene(), access, building_.local(place), glm::vec3(0, 0, -1),
                   deepest_m, [&](const Facing& f) {
                     return f.surface >= building_.scene().description->objects.size() ||
                            lets_light_through(f.kind) || f.distance_m < own_body_m;
                   });
    if (stop) met = place.z - static_cast<double>(stop->distance_m);
  });
  if (!met) return stated;
  return stated && *stated < *met && *met - *stated < desk_m ? stated : met;
}

/// Where a point of emphasis is looked from: before its front, else from all around it, since a
/// door's or a stair's point may lie in the door or the step itself.
std::vector<glm::dvec3> beside(const EmphasisPoint& point) {
  if (point.facing) return {point.position + *point.facing * floor_plane_m};
  const glm::dvec3 place = point.position + glm::dvec3(0, 0, floor_plane_m);
  std::vector<glm::dvec3> out{place};
  for (const glm::dvec2 aside : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
    out.push_back(place + glm::dvec3(aside * beside_m, 0));
  return out;
}

/// Points of an area within `border_m` of its edge are none of it, nor are those in furniture and
/// walls: nobody walks or works there. How many these are stands beside the checks.
std::vector<Check> CodeMode::of_area(
    const AssessedArea& area, double border_m,
    const std::function<std::vector<Check>(const std::vector<LitPoint>&, const CodeChoice&)>&
        checks) const {
  const glm::dvec3 up(0, 0, 1);
  const auto all = within(area, border_m, area_grid_m);
  std::vector<char> inside(all.size(), 0);
  building_.each(all.size(), [&](const GeometryAccess& access, size_t i) {
    inside[i] = building_.in_solid(access, all[i] + up * floor_plane_m) ? 1 : 0;
  });
  std::vector<glm::dvec3> places;
  for (size_t i = 0; i < all.size(); ++i)
    if (inside[i] == 0) places.push_back(all[i]);
  const auto points = lit(places, up, floor_plane_m);
  std::vector<Check> out;
  for (const CodeChoice& codes : codes_) append(out, checks(points, codes));
  if (places.size() < all.size())
    add_condition(out, fmt::format("{} of {} points lie in bodies and are left out",
                                   all.size() - places.size(), all.size()));
  return out;
}

std::vector<Check> CodeMode::checks_by_light() const {
  std::vector<Check> out;
  const auto add = [&](const auto& checks) {
    for (const CodeChoice& codes : codes_) append(out, checks(codes));
  };
  for (const EscapeRoute& route : scene_.routes) append(out, of_route(route));
  for (const AssessedArea& area : scene_.open_areas)
    append(out, of_area(area, 0.5, [&](const auto& core, const CodeChoice& codes) {
             auto checks = checks_of_open_area(scene_, area, core, codes);
             if (&codes == &codes_.front())
               checks.push_back(check_of_failure(scene_, "open area \"" + area.name + "\"", core));
             return checks;
           }));
  for (const AssessedArea& area : scene_.task_areas)
    append(out, of_area(area, 0, [&](const auto& plane, const CodeChoice& codes) {
             return checks_of_task_area(scene_, area, plane, codes);
           }));
  for (const EmphasisPoint& point : emphasis_of(scene_)) {
    const LinesOfSight seen = seen_from(beside(point));
    const auto lux = vertical_lux(point);
    add([&](const CodeChoice& codes) {
      return checks_of_emphasis(scene_, point, seen, lux, codes);
    });
  }
  return out;
}

std::vector<Check> CodeMode::checks_of_parts() const {
  std::vector<Check> out;
  const FloorUnder floor = [this](const glm::dvec3& place) { return floor_under(place); };
  for (const Sign& sign : scene_.signs) {
    const double lux = lux_on_face(sign);
    const LinesOfSight seen = seen_from(
        {sign.frame.origin + sign.frame.axes[2] * (sign.thickness_m / 2 + floor_plane_m)});
    for (const CodeChoice& codes : codes_)
      append(out, checks_of_sign(scene_, sign, lux, seen, codes, floor));
  }
  for (const CodeChoice& codes : codes_) {
    append(out, checks_of_glare(scene_, codes, floor));
    append(out, checks_of_height(scene_, codes, floor));
    append(out, checks_beyond(scene_, codes));
  }
  return out;
}

void CodeMode::fill_plan(std::vector<PlanLevel>& levels) const {
  const auto sum = [](const LitPoint& p) {
    return std::accumulate(p.lux.begin(), p.lux.end(), 0.0);
  };
  std::vector<glm::dvec3> places;
  for (const EscapeRoute& route : scene_.routes) {
    const auto more = within(route, route.width_m / 2 - route_grid_m, 2 * route_grid_m);
    places.insert(places.end(), more.begin(), more.end());
  }
  for (const AssessedArea& area : scene_.open_areas) {
    const auto more = within(area, area_grid_m / 2, area_grid_m);
    places.insert(places.end(), more.begin(), more.end());
  }
  const glm::dvec3 up(0, 0, 1);
  for (const LitPoint& p : lit(places, up, floor_plane_m))
    levels[level_of(levels, p.place.z)].points.push_back({p.place, sum(p)});
  for (size_t i = 0; i < levels.size(); ++i) {
    LightMap& map = levels[i].map = map_of(scene_, levels, i);
    std::vector<glm::dvec3> grid;
    for (int row = 0; row < map.rows; ++row)
      for (int column = 0; column < map.columns; ++column)
        grid.emplace_back(map.corner + glm::dvec2(column, row) * map.spacing_m, levels[i].floor_m);
    for (const LitPoint& p : lit(grid, up, floor_plane_m)) map.lux.push_back(sum(p));
  }
}

}  // namespace

Result<void> assess_by_codes(const SceneDescription& scene, const Scenario& scenario,
                             const AssessOptions& options, const AssessProgress& progress,
                             Assessment& out) {
  const SceneDescription switched = as_switched(scene, scenario);
  const bool has_furniture = std::any_of(scene.objects.begin(), scene.objects.end(), is_furniture);
  for (const bool furnished : {false, true}) {
    if (furnished && !has_furniture) break;
    progress(furnished ? "codes, with furniture" : "codes, without furniture", furnished ? 0.5 : 0);
    auto building = Building::make(code_scene(switched, furnished),
                                   code_scenario(switched, scenario), options.threads);
    if (!building) return building.problem();
    const CodeMode mode(switched, *building.value(), out.state.codes);
    if (!furnished) mode.fill_plan(out.levels);
    auto checks = mode.checks_by_light();
    if (has_furniture) add_condition(checks, furnished ? "with furniture" : "without furniture");
    append(out.checks, checks);
    if (!furnished) append(out.checks, mode.checks_of_parts());
  }
  progress("codes", 1);
  return {};
}

}  // namespace luxodus
