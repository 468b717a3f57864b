#include "actors/judge/assess/code_light.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "actors/judge/assess/storey_floor.hpp"
#include "actors/judge/inspect/site.hpp"
#include "scenes/light/signs/onset.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/transport/compile_light.hpp"
#include "scenes/light/transport/surroundings.hpp"
#include "scenes/light/world/design.hpp"

namespace luxodus {

namespace {

/// Distance from a point in a wall or a door to the places from which it is looked at [m].
constexpr double beside_m = 0.3;
/// A line to a luminous opening ends this far before it, since it may lie in a ceiling [m].
constexpr double before_opening_m = 0.01;
/// An intensity below this share of the luminaire's largest counts as no light.
constexpr double faint_share = 1e-3;
/// Places in gaps of a grid keep this distance from upright surfaces [m].
constexpr double touching_m = 0.003;
/// A surface less than this above the floor of a route is no floor but a desk or counter [m].
constexpr double desk_m = 1.3;

/// A box around all points from which an emitter may shine.
Bounds box_of(const CompiledEmitter& e, const glm::dvec3& origin) {
  Bounds out;
  for (const Vec3& corner : e.corners) out.extend(origin + glm::dvec3(corner));
  const glm::dvec3 centre = origin + glm::dvec3(e.origin);
  const double radius = glm::length(glm::dvec3(e.size));
  if (e.kind != EmitterKind::mesh) {
    out.extend(centre - radius);
    out.extend(centre + radius);
  }
  return out;
}

DirectOptions clear_air() {
  DirectOptions options;
  options.media = false;
  return options;
}

/// Changes the emergency light of every luminaire and sign, and of the types of a design.
void change_emergency_light(SceneDescription& scene, const std::function<void(Emitter&)>& luminaire,
                            const std::function<void(Sign&)>& sign) {
  const auto change_sign = [&](Sign& one) {
    if (one.lighting == SignLighting::internal) sign(one);
  };
  for (Emitter& e : scene.emitters) luminaire(e);
  for (Sign& one : scene.signs) change_sign(one);
  if (!scene.design) return;
  DesignSettings design = *scene.design;
  for (DesignType& type : design.types) luminaire(type.emitter);
  for (DesignSignType& type : design.sign_types) change_sign(type.sign);
  scene.design = std::make_shared<const DesignSettings>(std::move(design));
}

}  // namespace

SceneDescription after_circuits(const SceneDescription& scene, const Scenario& state) {
  SceneDescription out = scene;
  if (state.operation == Operation::mains) return out;
  const auto factor = [&](const std::string& circuit) {
    return std::min(1.0, factor_of(state.circuits, circuit, 1));
  };
  change_emergency_light(
      out, [&](Emitter& e) { e.emergency_flux *= factor(e.circuit); },
      [&](Sign& sign) { scale_luminances(sign, 1, factor(sign.circuit)); });
  return out;
}

SceneDescription as_switched(const SceneDescription& scene, const Scenario& state) {
  SceneDescription out = after_circuits(scene, state);
  if (state.operation == Operation::mains || !state.says_seconds) return out;
  const double seconds = state.seconds_after_failure;
  change_emergency_light(
      out,
      [&](Emitter& e) {
        if (is_exhausted(e.duration_s, seconds)) e.emergency_flux = 0;
      },
      [&](Sign& sign) {
        if (is_exhausted(sign.duration_s, seconds)) scale_luminances(sign, 1, 0);
      });
  return out;
}

SceneDescription code_scene(const SceneDescription& scene, bool furnished) {
  SceneDescription out = without_measurements(scene);
  out.media.clear();
  std::erase_if(out.emitters, [](const Emitter& e) { return !(e.emergency_flux > 0); });
  // Geometry is needed even without emergency luminaires, and a scene compiles only with light.
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

std::vector<glm::dvec3> beside(const EmphasisPoint& point) {
  if (point.facing) return {point.position + *point.facing * floor_plane_m};
  const glm::dvec3 place = point.position + glm::dvec3(0, 0, floor_plane_m);
  std::vector<glm::dvec3> out{place};
  for (const glm::dvec2 aside : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
    out.push_back(place + glm::dvec3(aside * beside_m, 0));
  return out;
}

glm::dvec3 before_face(const Sign& sign) {
  return sign.frame.origin + sign.frame.axes[2] * (sign.thickness_m / 2 + floor_plane_m);
}

CodeLight::CodeLight(const SceneDescription& scene, const Building& building,
                     std::vector<uint32_t> places)
    : scene_(scene),
      building_(building),
      screens_(building.scene()),
      floor_(building),
      luminaires_(emergency_luminaires(scene)),
      places_(std::move(places)) {
  if (luminaires_.empty()) return;
  const auto& emitters = building.scene().emitters;
  for (uint32_t i = 0; i < emitters.size(); ++i)
    if (emitters[i].sign == none_index) columns_.push_back(i);
  find_storeys();
}

/// From the lowest luminaire up: one too far above the lowest of its storey begins a new storey.
/// Those of a storey are tested together.
void CodeLight::find_storeys() {
  std::vector<uint32_t> by_height(columns_.size());
  std::iota(by_height.begin(), by_height.end(), 0U);
  std::vector<Bounds> boxes;
  for (const uint32_t column : columns_)
    boxes.push_back(box_of(building_.scene().emitters[column], building_.scene().local_origin));
  std::stable_sort(by_height.begin(), by_height.end(),
                   [&](uint32_t a, uint32_t b) { return boxes[a].low.z < boxes[b].low.z; });
  for (const uint32_t i : by_height) {
    if (storeys_.empty() || boxes[i].low.z > storeys_.back().box.low.z + storey_m)
      storeys_.emplace_back();
    storeys_.back().box.extend(boxes[i]);
    storeys_.back().luminaires.push_back(i);
  }
  for (Storey& storey : storeys_) {
    std::sort(storey.luminaires.begin(), storey.luminaires.end());
    for (const uint32_t i : storey.luminaires) storey.boxes.push_back(boxes[i]);
  }
}

std::vector<uint32_t> CodeLight::in_question(const glm::dvec3& place) const {
  std::vector<uint32_t> out;
  for (const Storey& storey : storeys_) {
    if (screens_.hide(place, storey.box)) continue;
    for (size_t i = 0; i < storey.luminaires.size(); ++i)
      if (!screens_.hide(place, storey.boxes[i])) out.push_back(storey.luminaires[i]);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<LitPoint> CodeLight::lit(const std::vector<glm::dvec3>& places,
                                     const glm::dvec3& normal, double lift_m) const {
  std::vector<LitPoint> out(places.size());
  building_.each(places.size(), [&](const GeometryAccess& access, size_t i) {
    out[i].place = places[i] + normal * lift_m;
    out[i].lux = light_at(access, out[i].place, normal);
  });
  return out;
}

/// The first of several luminaires in one place is traced. The others are skipped if it is fully
/// hidden, and need no rays if it is fully visible.
std::vector<double> CodeLight::light_at(const GeometryAccess& access, const glm::dvec3& place,
                                        const glm::dvec3& normal) const {
  std::vector<double> out(columns_.size(), 0);
  const CompiledScene& scene = building_.scene();
  const glm::vec3 local = building_.local(place), facing(normal);
  const std::vector<uint32_t> asked = in_question(place);
  DirectOptions options = clear_air();
  std::vector<uint32_t> leaders, others;
  for (const uint32_t i : asked)
    if (leads(i)) leaders.push_back(i);
  std::vector<DirectFromEmitter> of_leaders;
  std::vector<KnownSight> known(scene.emitters.size(), KnownSight::nothing);
  if (!leaders.empty()) {
    const auto columns = columns_of(leaders);
    options.only = columns;
    of_leaders = direct_lights(scene, access, local, facing, options);
  }
  size_t leader = 0;
  for (const uint32_t i : asked) {
    while (leader + 1 < leaders.size() && leaders[leader + 1] <= i) ++leader;
    const bool known_leader = !leaders.empty() && leaders[leader] == leader_of(i);
    if (leads(i)) {
      out[i] = of_leaders[leader].illuminance_lx;
    } else if (!known_leader) {
      others.push_back(i);  // a screen hides only the first of this place
    } else if (const DirectFromEmitter& seen = of_leaders[leader];
               !(seen.illuminance_lx == 0 && seen.open_lx > 0)) {
      const bool clear = seen.open_lx > 0 && seen.illuminance_lx >= seen.open_lx * (1 - 1e-9);
      if (clear) known[columns_[i]] = KnownSight::clear;
      others.push_back(i);
    }
  }
  if (others.empty()) return out;
  const auto columns = columns_of(others);
  options.only = columns;
  options.known = known;
  const auto of_others = direct_by_emitter(scene, access, local, facing, options);
  for (size_t k = 0; k < others.size(); ++k) out[others[k]] = of_others[k];
  return out;
}

std::vector<uint32_t> CodeLight::columns_of(const std::vector<uint32_t>& luminaires) const {
  std::vector<uint32_t> out;
  for (const uint32_t i : luminaires) out.push_back(columns_[i]);
  return out;
}

CalculationGrid CodeLight::without_bodies(const CalculationGrid& grid) const {
  std::vector<char> inside(grid.places.size(), 0);
  building_.each(inside.size(), [&](const GeometryAccess& access, size_t i) {
    inside[i] = is_in_body(access, grid.places[i]) ? 1 : 0;
  });
  CalculationGrid out;
  std::vector<uint32_t> number(inside.size(), 0);
  for (size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] != 0) continue;
    number[i] = static_cast<uint32_t>(out.places.size());
    out.places.push_back(grid.places[i]);
  }
  out.in_bodies = grid.places.size() - out.places.size();
  for (GridGap gap : grid.gaps) {
    const auto left = std::find_if(gap.corners.begin(), gap.corners.end(),
                                   [&](uint32_t corner) { return inside[corner] == 0; });
    if (left == gap.corners.end()) continue;
    const uint32_t known = *left;
    for (uint32_t& corner : gap.corners) corner = number[inside[corner] == 0 ? corner : known];
    out.gaps.push_back(gap);
  }
  return out;
}

CalculationGrid CodeLight::points_of(const AssessedArea& area, double border_m) const {
  return without_bodies(grid_of(area, border_m, area_grid_m));
}

RoutePoints CodeLight::points_of(const EscapeRoute& route) const {
  RoutePoints out = luxodus::points_of(
      route, [&](double aside_m) { return floor_.line(route, aside_m, route_grid_m); });
  for (CalculationGrid* grid : {&out.centre, &out.band, &out.inner}) *grid = without_bodies(*grid);
  return out;
}

CalculationGrid CodeLight::points_within(const EscapeRoute& route, double half_width_m,
                                         double spacing_m) const {
  return without_bodies(grid_within(half_width_m, spacing_m, [&](double aside_m) {
    return floor_.line(route, aside_m, spacing_m);
  }));
}

std::vector<LitPoint> CodeLight::lit_off_bodies(const std::vector<glm::dvec3>& places) const {
  std::vector<char> is_free(places.size(), 0);
  building_.each(places.size(), [&](const GeometryAccess& access, size_t i) {
    is_free[i] = is_in_body(access, places[i]) || touches_a_surface(access, places[i]) ? 0 : 1;
  });
  std::vector<glm::dvec3> free;
  for (size_t i = 0; i < places.size(); ++i)
    if (is_free[i] != 0) free.push_back(places[i]);
  return lit(free, {0, 0, 1}, floor_plane_m);
}

bool CodeLight::touches_a_surface(const GeometryAccess& access, const glm::dvec3& place) const {
  const glm::dvec3 middle = place + glm::dvec3(0, 0, floor_plane_m);
  for (const glm::dvec2 way : {glm::dvec2(1, 0), {0, 1}, {0.7, 0.7}, {0.7, -0.7}}) {
    const glm::dvec3 before = middle - glm::dvec3(way * touching_m, 0);
    const auto met =
        first_stop(building_.scene(), access, building_.local(before),
                   Vec3(glm::normalize(glm::dvec3(way, 0))), static_cast<Real>(2 * touching_m),
                   [](const FacedSurface& f) { return lets_light_through(f.kind); });
    if (met) return true;
  }
  return false;
}

bool CodeLight::is_in_body(const GeometryAccess& access, const glm::dvec3& place) const {
  return building_.in_solid(access, place + glm::dvec3(0, 0, floor_plane_m));
}

std::optional<std::vector<double>> CodeLight::vertical_lux(const EmphasisPoint& point) const {
  if (!point.facing) return std::nullopt;
  return lit({point.position}, *point.facing, floor_plane_m).front().lux;
}

std::vector<double> CodeLight::lux_on_face(const Sign& sign) const {
  if (sign.lighting != SignLighting::external) return {};
  std::vector<glm::dvec3> places;
  for (const double u : {-0.25, 0.25})
    for (const double v : {-0.25, 0.25})
      places.push_back(sign.frame.origin + sign.frame.axes[0] * (u * sign.width_m) +
                       sign.frame.axes[1] * (v * sign.height_m));
  std::vector<double> out(columns_.size(), 0);
  for (const LitPoint& p : lit(places, sign.frame.axes[2], 0.002))
    for (size_t i = 0; i < out.size(); ++i) out[i] += p.lux[i] / static_cast<double>(places.size());
  return out;
}

LinesOfSight CodeLight::seen_from(const std::vector<glm::dvec3>& places) const {
  std::vector<char> seen(luminaires_.size(), 0);
  building_.each(luminaires_.size(), [&](const GeometryAccess& access, size_t i) {
    const glm::dvec3 lamp = scene_.emitters[luminaires_[i]].frame.origin;
    for (const glm::dvec3& place : places) {
      const double distance = glm::length(place - lamp);
      if (!(distance > before_opening_m) || screens_.hide(place, {lamp, lamp})) continue;
      const glm::dvec3 before = lamp + (place - lamp) * (before_opening_m / distance);
      if (clear_share(building_.scene(), access, building_.local(place), building_.local(before),
                      scene_.emitters[luminaires_[i]].body) > 0 &&
          shines_at(access, i, place))
        seen[i] = 1;
    }
  });
  return LinesOfSight(seen.begin(), seen.end());
}

bool CodeLight::shines_at(const GeometryAccess& access, size_t luminaire,
                          const glm::dvec3& place) const {
  const Emitter& e = scene_.emitters[luminaires_[luminaire]];
  if (e.distribution == Distribution::web) {
    const glm::dvec3 local = glm::transpose(e.frame.axes) * glm::normalize(place - e.frame.origin);
    return e.web->intensity(local) > faint_share * e.web->peak_cd();
  }
  // Simple shapes: by the illuminance on a surface that faces the luminaire.
  if (luminaire >= columns_.size()) return true;
  DirectOptions options = clear_air();
  options.only = {&columns_[luminaire], 1};
  return direct_by_emitter(building_.scene(), access, building_.local(place),
                           glm::vec3(glm::normalize(e.frame.origin - place)), options)
             .front() > 0;
}

std::optional<double> CodeLight::floor_under(const glm::dvec3& place) const {
  const auto stated = floor_below(scene_, place);
  std::optional<double> met;
  building_.each(1, [&](const GeometryAccess& access, size_t) {
    met = surface_below(building_, access, place);
  });
  if (!met) return stated;
  return stated && *stated < *met && *met - *stated < desk_m ? stated : met;
}

}  // namespace luxodus
