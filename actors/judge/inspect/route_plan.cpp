// Inspects escape routes in plan: whether they end at an exit, turn back on themselves, or are
// written twice.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/judge/inspect/doorway.hpp"
#include "actors/judge/inspect/ways_size.hpp"
#include "scenes/emergency/sign_geometry.hpp"

namespace luxodus {

namespace {

/// A door, an opening, a point of emphasis, or a sign, belongs to the end of a route within this
/// distance [m].
constexpr double exit_within_m = 2.5;
constexpr double sign_within_m = 3;
/// Limit on height differences within one storey [m].
constexpr double one_storey_m = 2.2;
constexpr double waist_of_walker_m = 1;
constexpr double eye_of_walker_m = 1.65;
/// Signs hang at most this high above a route's floor [m].
constexpr double highest_sign_m = 6;
constexpr double doorway_step_m = 0.1;
constexpr int ways_out = 8;
/// Largest distance of a route's end from a route that it joins [m].
constexpr double joins_m = 1;
/// Steps by which two stretches of routes are compared, and the tolerance for equal places [m].
constexpr double stretch_step_m = 0.25;
constexpr double one_line_m = 0.2;
/// Cosines between opposite, and between equal directions.
constexpr double opposite = -0.9;
constexpr double one_way = 0.95;

bool is_way_out(EmphasisKind kind) {
  return kind == EmphasisKind::exit_door || kind == EmphasisKind::final_exit ||
         kind == EmphasisKind::stairs || kind == EmphasisKind::refuge;
}

/// Without named exits, routes cannot be checked for leading to one.
bool names_exits(const SceneDescription& scene) {
  const auto& points = scene.emphasis;
  const auto& objects = scene.objects;
  return !scene.signs.empty() || std::any_of(objects.begin(), objects.end(), [](const Object& o) {
    return o.door.has_value();
  }) || std::any_of(points.begin(), points.end(), [](const EmphasisPoint& p) {
    return is_way_out(p.kind);
  });
}

bool is_near(const glm::dvec3& a, const glm::dvec3& b, double within_m) {
  return glm::length(glm::dvec2(a - b)) <= within_m && std::abs(a.z - b.z) <= one_storey_m;
}

/// Whether the scene has an exit near a place on the floor: a point of emphasis, or a door leaf.
bool has_named_exit(const SceneDescription& scene, const glm::dvec3& foot) {
  for (const EmphasisPoint& point : scene.emphasis)
    if (is_way_out(point.kind) && is_near(point.position, foot, exit_within_m)) return true;
  for (const Object& object : scene.objects) {
    if (!object.door) continue;
    for (const glm::dvec3& p : object.mesh.positions)
      if (is_near(p, foot, exit_within_m)) return true;
  }
  return false;
}

bool has_sign(const SceneDescription& scene, const EscapeRoute& route, const glm::dvec3& foot) {
  const auto steps = steps_along(route, 1);
  return std::any_of(scene.signs.begin(), scene.signs.end(), [&](const Sign& sign) {
    const glm::dvec3 to = sign.frame.origin - foot;
    if (glm::length(glm::dvec2(to)) > sign_within_m || to.z < 0 || to.z > highest_sign_m)
      return false;
    return std::any_of(steps.begin(), steps.end(), [&](const Walker& w) {
      return !view_of_sign(sign, w.foot + glm::dvec3(0, 0, eye_of_walker_m)).behind;
    });
  });
}

/// Whether there is an opening near a place on the floor, or the outside of the building.
bool has_opening(const Site& site, const GeometryAccess& access, const glm::dvec3& foot,
                 const glm::dvec3& ahead) {
  const glm::dvec3 place = foot + glm::dvec3(0, 0, waist_of_walker_m);
  const glm::dvec2 level(ahead);
  const double first = glm::length(level) > 0 ? std::atan2(level.y, level.x) : 0;
  for (int i = 0; i < ways_out; ++i) {
    const double angle = first + 2 * std::numbers::pi * i / ways_out;
    const glm::dvec3 way(std::cos(angle), std::sin(angle), 0);
    const auto wall = wall_ahead(site, access, place, way, exit_within_m);
    const double clear = wall ? static_cast<double>(wall->distance_m) : exit_within_m;
    for (double gone = 0; gone < clear; gone += doorway_step_m)
      if (doorway_at(site, access, place + way * gone, way)) return true;
    if (!wall && site.is_outside(access, place + way * exit_within_m)) return true;
  }
  return false;
}

/// Whether another route continues where this one ends, other than back.
bool is_led_on(const SceneDescription& scene, const EscapeRoute& route) {
  const glm::dvec3 end = route.path.back();
  const glm::dvec3 ahead = glm::normalize(end - route.path[route.path.size() - 2]);
  return std::any_of(scene.routes.begin(), scene.routes.end(), [&](const EscapeRoute& other) {
    if (&other == &route) return false;
    const auto steps = steps_along(other, stretch_step_m);
    return std::any_of(steps.begin(), steps.end(), [&](const Walker& w) {
      return is_near(w.foot, end, other.width_m / 2 + joins_m) &&
             glm::dot(w.ahead, ahead) > opposite;
    });
  });
}

bool ends_at_exit(const Site& site, const GeometryAccess& access, const EscapeRoute& route,
                  bool at_start) {
  const auto& path = route.path;
  const glm::dvec3 foot = at_start ? path.front() : path.back();
  const glm::dvec3 before = at_start ? path[1] : path[path.size() - 2];
  return has_named_exit(site.scene, foot) || (!at_start && has_sign(site.scene, route, foot)) ||
         has_opening(site, access, foot, foot - before);
}

std::optional<Finding> ends_nowhere(const Site& site, const GeometryAccess& access,
                                    const EscapeRoute& route) {
  if (is_led_on(site.scene, route) || ends_at_exit(site, access, route, false)) return std::nullopt;
  const glm::dvec3 end = route.path.back() + glm::dvec3(0, 0, waist_of_walker_m);
  if (site.remote.told("", end) || site.in_body(access, end)) return std::nullopt;
  const bool reversed = ends_at_exit(site, access, route, true);
  return Finding{
      Severity::warning,
      "route",
      {route.place,
       fmt::format("route \"{}\" ends at {}, where nobody gets out: no door, opening, exit sign or "
                   "point of emphasis of an exit is within {}, and no other route leads on; {}",
                   route.name, place_text(route.path.back()), length_text(exit_within_m),
                   reversed ? "it begins at an exit: write its points the other way round, in the "
                              "direction of escape"
                            : "lead it on to the exit")}};
}

/// Reports two stretches of one line in opposite directions.
std::optional<Finding> turns_back(const EscapeRoute& route) {
  const auto steps = steps_along(route, stretch_step_m);
  for (size_t i = 0; i < steps.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      if (glm::length(steps[i].foot - steps[k].foot) > one_line_m ||
          glm::dot(steps[i].ahead, steps[k].ahead) > opposite)
        continue;
      return Finding{
          Severity::warning,
          "route",
          {route.place,
           fmt::format("route \"{}\" turns back on itself at {}: signs that show the way on are "
                       "behind whoever walks there; give its points the order of the way out, "
                       "and each direction a route of its own",
                       route.name, place_text(steps[i].foot))}};
    }
  return std::nullopt;
}

/// Whether all of one route lies on the other, in the same direction.
bool runs_along(const std::vector<Walker>& one, const std::vector<Walker>& other) {
  return std::all_of(one.begin(), one.end(), [&](const Walker& w) {
    return std::any_of(other.begin(), other.end(), [&](const Walker& o) {
      return glm::length(w.foot - o.foot) <= one_line_m && glm::dot(w.ahead, o.ahead) > one_way;
    });
  });
}

void find_double_routes(const SceneDescription& scene, Findings& out) {
  const auto& routes = scene.routes;
  std::vector<std::vector<Walker>> steps;
  for (const EscapeRoute& route : routes) steps.push_back(steps_along(route, stretch_step_m));
  for (size_t i = 0; i < routes.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      if (!runs_along(steps[i], steps[k]) || !runs_along(steps[k], steps[i])) continue;
      out.push_back({Severity::warning,
                     "same place",
                     {routes[i].place,
                      fmt::format("route \"{}\" leads the very way of route \"{}\" (line {}): "
                                  "remove one of them, or lead it where it should",
                                  routes[i].name, routes[k].name, routes[k].place.line)}});
    }
}

}  // namespace

void inspect_route_plan(const Site& site, Findings& out) {
  const auto& routes = site.scene.routes;
  const bool exits = names_exits(site.scene);
  std::vector<std::optional<Finding>> ends(routes.size()), turns(routes.size());
  site.building.each(routes.size(), [&](const GeometryAccess& access, size_t i) {
    turns[i] = turns_back(routes[i]);
    if (exits && !turns[i]) ends[i] = ends_nowhere(site, access, routes[i]);
  });
  for (auto* list : {&ends, &turns})
    for (auto& finding : *list)
      if (finding) out.push_back(std::move(*finding));
  find_double_routes(site.scene, out);
}

}  // namespace luxodus
