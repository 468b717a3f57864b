// Finds places of people, and signs they look at, outside the meshes of fire simulations, and grids
// that begin above the floor. The air there is unknown, and assuming clear air would make verdicts
// too good.
#include <algorithm>
#include <functional>

#include "actors/judge/inspect/site.hpp"
#include "actors/judge/inspect/ways_size.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// Spacing of the places of people, and of samples along a line of sight [m].
constexpr double fire_places_m = 1, sight_step_m = 0.1;
/// Limits on lines of sight: length [m], and number.
constexpr double farthest_sight_m = 60;
constexpr size_t max_fire_sights = 100'000;
/// Things on a wall or ceiling may lie slightly outside the gas [m].
constexpr double on_wall_m = 0.1;
/// Cells of a fire simulation have 0.1 to 0.25 m: a grid that begins so far above a floor was not
/// made for it [m].
constexpr double above_floor_m = 0.26;

struct Tried {
  std::string of;  // route "corridor"
  SourcePlace place;
  glm::dvec3 at{0};
};

/// Eyes on routes, in open areas and of observers.
std::vector<Tried> eyes_tried(const SceneDescription& scene) {
  std::vector<Tried> out;
  const auto add_eyes = [&](const std::string& of, const SourcePlace& place, const glm::dvec3& p) {
    for (const double height : scene.assessment.eye_heights_m)
      out.push_back({of, place, p + glm::dvec3(0, 0, height)});
  };
  for (const EscapeRoute& route : scene.routes)
    for (const glm::dvec3& p : places_along(route, fire_places_m))
      add_eyes("route \"" + route.name + "\"", route.place, p);
  for (const AssessedArea& area : scene.open_areas)
    for (const glm::dvec3& p : places_within(area, 0.5, fire_places_m))
      add_eyes("open area \"" + area.name + "\"", area.place, p);
  for (const Observer& o : scene.observers)
    out.push_back({"observer \"" + o.name + "\"", o.place, o.eye});
  return out;
}

/// The union of a simulation's meshes, in scene coordinates.
class KnownAir {
 public:
  explicit KnownAir(const FireSimulation& fire) : fire_(fire) {}

  bool holds(const glm::dvec3& place, double slack_m) const {
    const glm::dvec3 p = (place - fire_.frame.origin) * fire_.frame.axes;
    return std::any_of(fire_.meshes.begin(), fire_.meshes.end(), [&](const Bounds& mesh) {
      return glm::all(glm::greaterThanEqual(p, mesh.low - slack_m)) &&
             glm::all(glm::lessThanEqual(p, mesh.high + slack_m));
    });
  }

  /// The first place on a line outside the meshes.
  std::optional<glm::dvec3> leaves(const glm::dvec3& from, const glm::dvec3& to) const {
    const int steps = static_cast<int>(glm::length(to - from) / sight_step_m) + 1;
    for (int i = 0; i <= steps; ++i) {
      const glm::dvec3 at = from + (to - from) * (static_cast<double>(i) / steps);
      if (!holds(at, on_wall_m)) return at;
    }
    return std::nullopt;
  }

 private:
  const FireSimulation& fire_;
};

std::string outside_words(const Medium& m) {
  return "outside of the meshes of the fire simulation \"" + m.name +
         "\": nothing is known of the smoke there, and clear air would be optimistic";
}

/// Reports eyes outside, the first one of each route, area and observer.
void tell_places(const Medium& m, const KnownAir& air, const std::vector<Tried>& eyes,
                 Findings& out) {
  std::vector<std::string> told;
  for (const Tried& eye : eyes) {
    if (air.holds(eye.at, 0) || std::count(told.begin(), told.end(), eye.of) > 0) continue;
    told.push_back(eye.of);
    out.push_back(
        {Severity::error,
         "smoke",
         {eye.place, fmt::format("an eye of the {}, at {}, is ", eye.of, place_text(eye.at)) +
                         outside_words(m)}});
  }
}

/// Whether a grid of cells holds a place.
bool holds(const Medium& m, const glm::dvec3& place) {
  const glm::dvec3 p = (place - m.frame.origin) * m.frame.axes;
  return glm::all(glm::greaterThanEqual(p, glm::dvec3(0))) &&
         glm::all(glm::lessThanEqual(p, m.data.extent));
}

/// Reports grids whose lower face lies above the floor on which people stand: they were made for
/// another floor, and clear air is below them.
void tell_raised(const SceneDescription& scene, const Medium& m,
                 const std::function<bool(const glm::dvec3&)>& known, Findings& out) {
  const auto& heights = scene.assessment.eye_heights_m;
  const glm::dvec3 lowest(0, 0, *std::min_element(heights.begin(), heights.end()));
  const glm::dvec3 foot(0, 0, above_floor_m);
  size_t all = 0, raised = 0;
  std::string where;
  const auto try_at = [&](const std::string& of, const glm::dvec3& p) {
    if (!known(p + lowest)) return;
    ++all;
    if (known(p + foot)) return;
    if (raised++ == 0) where = fmt::format("at {} (the {})", place_text(p), of);
  };
  for (const EscapeRoute& route : scene.routes)
    for (const glm::dvec3& p : places_along(route, fire_places_m))
      try_at("route \"" + route.name + "\"", p);
  for (const AssessedArea& area : scene.open_areas)
    for (const glm::dvec3& p : places_within(area, 0.5, fire_places_m))
      try_at("open area \"" + area.name + "\"", p);
  if (raised == 0 || 2 * raised < all) return;
  out.push_back({Severity::warning,
                 "smoke",
                 {m.place, fmt::format("the cells of \"{}\" begin more than {:g} m above the floor "
                                       "{}: is their height that of the building's floors?",
                                       m.name, above_floor_m, where)}});
}

/// Reports signs seen along a line that leaves the meshes, once each.
void tell_sights(const SceneDescription& scene, const Building& smoky, const Medium& m,
                 const KnownAir& air, const std::vector<Tried>& eyes, Findings& out) {
  struct Line {
    size_t eye, sign;
    glm::dvec3 outside;
  };
  std::vector<Line> lines;
  for (size_t sign = 0; sign < scene.signs.size(); ++sign)
    for (size_t eye = 0; eye < eyes.size() && lines.size() < max_fire_sights; ++eye) {
      const glm::dvec3 to = scene.signs[sign].frame.origin;
      if (glm::length(to - eyes[eye].at) > farthest_sight_m || !air.holds(eyes[eye].at, 0))
        continue;
      if (const auto outside = air.leaves(eyes[eye].at, to)) lines.push_back({eye, sign, *outside});
    }
  std::vector<char> seen(lines.size(), 0);
  smoky.each(lines.size(), [&](const GeometryAccess& access, size_t i) {
    const glm::dvec3 from = eyes[lines[i].eye].at;
    const glm::dvec3 way = scene.signs[lines[i].sign].frame.origin - from;
    const double length = glm::length(way) - on_wall_m;
    if (length <= 0) return;
    const auto stop = first_stop(smoky.scene(), access, smoky.local(from),
                                 Vec3(way / glm::length(way)), static_cast<Real>(length),
                                 [](const FacedSurface& f) { return lets_light_through(f.kind); });
    seen[i] = stop ? 0 : 1;
  });
  std::vector<size_t> told;
  for (size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    if (seen[i] == 0 || std::count(told.begin(), told.end(), line.sign) > 0) continue;
    told.push_back(line.sign);
    const Sign& sign = scene.signs[line.sign];
    out.push_back(
        {Severity::error,
         "smoke",
         {sign.place,
          fmt::format("the line of sight to \"{}\" from {} (the {}) passes {}, ", sign.name,
                      place_text(eyes[line.eye].at), eyes[line.eye].of, place_text(line.outside)) +
              outside_words(m)}});
  }
}

}  // namespace

bool is_of_simulation(const SceneDescription& scene, const Medium& m) {
  return std::any_of(scene.media.begin(), scene.media.end(), [&](const Medium& other) {
    return other.simulation && other.name == m.name && other.place.line == m.place.line;
  });
}

void inspect_fire_meshes(const SceneDescription& scene, const Building& smoky, Findings& out) {
  const auto eyes = eyes_tried(scene);
  for (const Medium& m : scene.media)
    if (m.kind == MediumKind::data_set && m.data.nx > 0 && !is_of_simulation(scene, m) &&
        factor_of_medium(smoky.scene().scenario, m) > 0)
      tell_raised(
          scene, m, [&](const glm::dvec3& p) { return holds(m, p); }, out);
  for (const Medium& m : scene.media) {
    if (!m.simulation || !(factor_of_medium(smoky.scene().scenario, m) > 0)) continue;
    const KnownAir air(*m.simulation);
    tell_raised(
        scene, m, [&](const glm::dvec3& p) { return air.holds(p, 0); }, out);
    tell_places(m, air, eyes, out);
    tell_sights(scene, smoky, m, air, eyes, out);
  }
}

}  // namespace luxodus
