#include "actors/judge/assess/code_mode.hpp"

#include <algorithm>

#include "actors/judge/assess/between_points.hpp"
#include "actors/judge/assess/clear_signs.hpp"
#include "actors/judge/assess/code_light.hpp"
#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/assess/storey_floor.hpp"
#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/far_field.hpp"

namespace luxodus {

namespace {

const glm::dvec3 up(0, 0, 1);

/// A plane nearer than this to a floor has the floor's map [m].
constexpr double on_floor_m = 0.1;

std::vector<glm::dvec3> places_of(const LightMap& map, double z_m) {
  std::vector<glm::dvec3> out;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      out.emplace_back(map.corner + glm::dvec2(column, row) * map.spacing_m, z_m);
  return out;
}

void append(std::vector<Check>& out, const std::vector<Check>& more) {
  out.insert(out.end(), more.begin(), more.end());
}

void add_condition(std::vector<Check>& checks, const Remark& condition) {
  for (Check& check : checks) check.conditions.push_back(condition);
}

class CodeMode {
 public:
  /// `scene`: after the circuits of the judged state; `now`: at its time, too. Requires: all
  /// outlive this.
  CodeMode(const SceneDescription& scene, const SceneDescription& now, const Building& building,
           const std::vector<CodeChoice>& codes)
      : scene_(scene), now_(now), building_(building), codes_(codes), light_(scene, building) {
    for (const uint32_t number : emergency_luminaires(scene))
      fed_.push_back(now.emitters[number].emergency_flux > 0);
    factors_ = factors_of_checks(scene, codes, fed_);
    std::vector<glm::dvec3> places;
    for (const uint32_t number : emergency_luminaires(scene))
      places.push_back(centre_of(scene.emitters[number]));
    luminaire_floors_ = storey_floors(scene, building, places);
  }

  /// Checks that furniture may change.
  std::vector<Check> checks_by_light() const;
  /// Checks of single signs and luminaires.
  std::vector<Check> checks_of_parts() const;
  /// Fills in each level's points of calculation and illuminance map.
  void fill_plan(std::vector<PlanLevel>& levels) const;
  /// The light on each route and area, for its chart.
  std::vector<SurfaceRecord> surfaces(const std::vector<PlanLevel>& levels) const;

 private:
  std::vector<Check> of_route(const EscapeRoute& route) const;
  std::vector<Check> of_area(
      const AssessedArea& area, double border_m,
      const std::function<std::vector<Check>(const JudgedPoints&, const CodeChoice&)>& checks)
      const;
  SurfaceRecord surface_of(const Subject& subject, const AssessedArea& area, double border_m,
                           const std::vector<PlanLevel>& levels) const;
  /// Adds points of calculation to a surface, if there are any.
  void add_grid(SurfaceRecord& surface, const char* kind, const CalculationGrid& grid) const;
  /// The light at the points of a grid and between them.
  JudgedPoints light_on(const CalculationGrid& grid) const;

  /// Illuminance at the judged time.
  double sum_of(const std::vector<double>& lux) const {
    double sum = 0;
    for (size_t i = 0; i < lux.size(); ++i) sum += fed_[i] ? lux[i] : 0;
    return sum;
  }

  // Light is that of luminaires whose supplies last; rules heed the time for which they do.
  const SceneDescription& scene_;
  const SceneDescription& now_;
  const Building& building_;
  const std::vector<CodeChoice>& codes_;
  CodeLight light_;
  FedLuminaires fed_;
  std::vector<LuminaireFactors> factors_;
  std::vector<std::optional<double>> luminaire_floors_;
};

JudgedPoints CodeMode::light_on(const CalculationGrid& grid) const {
  JudgedPoints out(light_.lit(grid.places, up, floor_plane_m));
  out.between = lit_between(scene_, light_, grid, out.grid, factors_);
  out.in_bodies = grid.in_bodies;
  return out;
}

std::vector<Check> CodeMode::of_route(const EscapeRoute& route) const {
  const RoutePoints points = light_.points_of(route);
  const RouteLight light{light_on(points.centre), light_on(points.band), light_on(points.inner)};
  const auto people = walkers(route, scene_.assessment.spacing_m);
  const auto clear = clear_signs(now_, building_, people);
  std::vector<std::pair<std::string, std::vector<LitPoint>>> flights;
  for (const FlightOfRoute& flight : light_.flights_of(route))
    flights.emplace_back(flight.name, light_.lit(flight.treads, up, floor_plane_m));
  std::vector<Check> out;
  for (const CodeChoice& codes : codes_) {
    append(out, checks_of_route(scene_, route, light, codes, fed_));
    for (const auto& [name, treads] : flights)
      append(out, checks_of_flight(name, treads, codes, fed_));
    append(out, checks_of_distance(now_, route, people, clear, codes));
  }
  out.push_back(check_of_failure(scene_, subject_of(route), light.centre, fed_));
  return out;
}

/// Points within `border_m` of the edge do not belong to an area, nor do points in furniture and
/// walls, where nobody walks or works. The checks state how many of the latter were left out.
std::vector<Check> CodeMode::of_area(
    const AssessedArea& area, double border_m,
    const std::function<std::vector<Check>(const JudgedPoints&, const CodeChoice&)>& checks) const {
  const CalculationGrid all = light_.points_of(area, border_m);
  const JudgedPoints points = light_on(all);
  std::vector<Check> out;
  for (const CodeChoice& codes : codes_) append(out, checks(points, codes));
  if (all.in_bodies > 0)
    add_condition(
        out, remark(RemarkId::points_in_bodies, all.in_bodies, all.in_bodies + all.places.size()));
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
             auto checks = checks_of_open_area(scene_, area, core, codes, fed_);
             if (&codes == &codes_.front())
               checks.push_back(
                   check_of_failure(scene_, {SubjectKind::open_area, area.name}, core, fed_));
             return checks;
           }));
  for (const AssessedArea& area : scene_.task_areas)
    append(out, of_area(area, 0, [&](const auto& plane, const CodeChoice& codes) {
             return checks_of_task_area(scene_, area, plane, codes, fed_);
           }));
  for (const EmphasisPoint& point : emphasis_of(scene_)) {
    const LinesOfSight seen = light_.seen_from(beside(point));
    const auto parts = light_.vertical_lux(point);
    const auto lux = parts ? std::optional(sum_of(*parts)) : std::nullopt;
    const StoreyFloors floors{storey_floor_around(scene_, building_, point.position, beside(point)),
                              luminaire_floors_};
    add([&](const CodeChoice& codes) {
      return checks_of_emphasis(scene_, point, seen, lux, codes, fed_, floors);
    });
  }
  return out;
}

std::vector<Check> CodeMode::checks_of_parts() const {
  std::vector<Check> out;
  const FloorUnder floor = [this](const glm::dvec3& place) { return light_.floor_under(place); };
  for (const Sign& sign : now_.signs) {
    const double lux = sum_of(light_.lux_on_face(sign));
    const std::vector<glm::dvec3> front{before_face(sign)};
    const LinesOfSight seen = light_.seen_from(front);
    const StoreyFloors floors{storey_floors(scene_, building_, front).front(), luminaire_floors_};
    for (const CodeChoice& codes : codes_)
      append(out, checks_of_sign(scene_, sign, lux, seen, codes, floor, fed_, floors));
  }
  for (const CodeChoice& codes : codes_) {
    append(out, checks_of_glare(scene_, codes, floor));
    append(out, checks_of_height(scene_, codes, floor));
    append(out, checks_beyond(scene_, codes));
  }
  return out;
}

void CodeMode::fill_plan(std::vector<PlanLevel>& levels) const {
  std::vector<glm::dvec3> places;
  for (const EscapeRoute& route : scene_.routes) {
    const auto more =
        light_.points_within(route, route.width_m / 2 - route_grid_m, 2 * route_grid_m).places;
    places.insert(places.end(), more.begin(), more.end());
  }
  for (const AssessedArea& area : scene_.open_areas) {
    const auto more = within(area, area_grid_m / 2, area_grid_m);
    places.insert(places.end(), more.begin(), more.end());
  }
  for (const LitPoint& p : light_.lit(places, up, floor_plane_m))
    levels[level_of(levels, p.place.z)].points.push_back({p.place, sum_of(p.lux)});
  for (size_t i = 0; i < levels.size(); ++i) {
    LightMap& map = levels[i].map = map_of(scene_, levels, i);
    for (const LitPoint& p : light_.lit(places_of(map, levels[i].floor_m), up, floor_plane_m))
      map.lux.push_back(drawn_lux(sum_of(p.lux)));
  }
}

void CodeMode::add_grid(SurfaceRecord& surface, const char* kind,
                        const CalculationGrid& grid) const {
  surface.in_bodies = std::max(surface.in_bodies, grid.in_bodies);
  if (grid.places.empty()) return;
  SurfaceGridRecord out{.kind = kind, .points = {}, .least = 0, .mean = 0, .most = 0};
  for (const LitPoint& p : light_.lit(grid.places, up, floor_plane_m)) {
    const double lux = sum_of(p.lux);
    if (out.points.empty() || lux < out.least) out.least = lux, out.darkest = p.place;
    if (out.points.empty() || lux > out.most) out.most = lux, out.brightest = p.place;
    out.mean += lux / static_cast<double>(grid.places.size());
    out.points.push_back({p.place, lux});
  }
  surface.grids.push_back(std::move(out));
}

SurfaceRecord CodeMode::surface_of(const Subject& subject, const AssessedArea& area,
                                   double border_m, const std::vector<PlanLevel>& levels) const {
  SurfaceRecord out{.subject = subject, .grids = {}, .in_bodies = 0, .map = {}};
  add_grid(out, "area", light_.points_of(area, border_m));
  if (std::abs(levels[level_of(levels, area.z_m)].floor_m - area.z_m) < on_floor_m) return out;
  out.map = map_over(area);
  for (const LitPoint& p : light_.lit(places_of(out.map, area.z_m), up, floor_plane_m))
    out.map.lux.push_back(drawn_lux(sum_of(p.lux)));
  return out;
}

std::vector<SurfaceRecord> CodeMode::surfaces(const std::vector<PlanLevel>& levels) const {
  std::vector<SurfaceRecord> out;
  for (const EscapeRoute& route : scene_.routes) {
    const RoutePoints points = light_.points_of(route);
    out.push_back({.subject = subject_of(route), .grids = {}, .in_bodies = 0, .map = {}});
    add_grid(out.back(), "centre", points.centre);
    add_grid(out.back(), "band", points.band);
  }
  for (const AssessedArea& area : scene_.open_areas)
    out.push_back(surface_of({SubjectKind::open_area, area.name}, area, 0.5, levels));
  for (const AssessedArea& area : scene_.task_areas)
    out.push_back(surface_of({SubjectKind::task_area, area.name}, area, 0, levels));
  std::erase_if(out, [](const SurfaceRecord& surface) { return surface.grids.empty(); });
  return out;
}

void find_floors(const SceneDescription& scene, const Building& building, Assessment& out) {
  std::vector<glm::dvec3> luminaires, signs;
  for (const Emitter& e : scene.emitters) luminaires.push_back(centre_of(e));
  for (const Sign& sign : scene.signs) signs.push_back(before_face(sign));
  out.luminaire_floors = storey_floors(scene, building, luminaires);
  out.sign_floors = storey_floors(scene, building, signs);
}

/// What is asked of a building beside its checks: called once, without furniture.
using Beside = std::function<void(const CodeMode& mode, const Building& building)>;

Result<std::vector<Check>> checked(const SceneDescription& scene, const Scenario& scenario,
                                   const std::vector<CodeChoice>& codes, int threads,
                                   const AssessProgress& progress, const Beside& beside) {
  std::vector<Check> out;
  const SceneDescription switched = after_circuits(scene, scenario);
  const SceneDescription now = as_switched(scene, scenario);
  const bool has_furniture = std::any_of(scene.objects.begin(), scene.objects.end(), is_furniture);
  for (const bool furnished : {false, true}) {
    if (furnished && !has_furniture) break;
    progress(furnished ? "codes, with furniture" : "codes, without furniture", furnished ? 0.5 : 0);
    auto building = Building::make(code_scene(switched, furnished),
                                   code_scenario(switched, scenario), threads);
    if (!building) return building.problem();
    const CodeMode mode(switched, now, *building.value(), codes);
    if (!furnished) beside(mode, *building.value());
    auto checks = mode.checks_by_light();
    if (has_furniture)
      add_condition(checks,
                    remark(furnished ? RemarkId::with_furniture : RemarkId::without_furniture));
    append(out, checks);
    if (furnished) continue;
    append(out, mode.checks_of_parts());
    for (const CodeChoice& one : codes) out.push_back(check_of_duration(scene, one));
  }
  progress("codes", 1);
  return out;
}

}  // namespace

Result<void> assess_by_codes(const SceneDescription& scene, const Scenario& scenario,
                             const AssessOptions& options, const AssessProgress& progress,
                             Assessment& out) {
  auto checks = checked(scene, scenario, out.state.codes, options.threads, progress,
                        [&](const CodeMode& mode, const Building& building) {
                          mode.fill_plan(out.levels);
                          out.surfaces = mode.surfaces(out.levels);
                          find_floors(scene, building, out);
                        });
  if (!checks) return checks.problem();
  append(out.checks, checks.value());
  return {};
}

Result<std::vector<Check>> checks_by_codes(const SceneDescription& scene, const Scenario& scenario,
                                           const std::vector<CodeChoice>& codes, int threads) {
  return checked(scene, scenario, codes, threads, [](const std::string&, double) {},
                 [](const CodeMode&, const Building&) {});
}

}  // namespace luxodus
