// Inspects points of emphasis: whether a door, an extinguisher or a call point can be at its stated
// place. Equipment hangs on something or stands on the floor, in reach; doors are in walls.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/judge/inspect/site.hpp"

namespace luxodus {

namespace {

/// The point is tested this far in front, so that one in a wall's face is not in the wall [m].
constexpr double before_point_m = 0.02;
/// Equipment is at most this far in front of what it hangs on [m].
constexpr double hung_m = 0.5;
/// Below the first, it stands on the floor or a plinth; above the second, it is out of reach [m].
constexpr double stands_m = 0.5;
constexpr double reach_m = 2.2;
/// A door farther from every wall is in none: half of a wide open side, plus a margin [m].
constexpr double door_wall_m = 3;
/// Places marked on the floor are at most this high, including door leaves [m].
constexpr double mark_height_m = 1.5;
/// The front of equipment is blocked by a solid this close [m].
constexpr double shut_front_m = 0.3;
constexpr double floor_far_below_m = 100;
constexpr int directions_around = 16;

bool is_equipment(EmphasisKind kind) {
  return kind == EmphasisKind::first_aid || kind == EmphasisKind::fire_equipment ||
         kind == EmphasisKind::call_point || kind == EmphasisKind::alarm_panel;
}

bool is_door(EmphasisKind kind) {
  return kind == EmphasisKind::exit_door || kind == EmphasisKind::final_exit;
}

/// Whether there is a solid within `length_m` horizontally, or at the place itself.
bool solid_around(const Site& site, const GeometryAccess& access, const glm::dvec3& place,
                  double length_m) {
  for (int i = 0; i < directions_around; ++i) {
    // Directions off the axes, along which walls run.
    const double angle = 2 * std::numbers::pi * (i + 0.3) / directions_around;
    const glm::dvec3 way(std::cos(angle), std::sin(angle), 0);
    if (solid_ahead(site, access, place, way, length_m)) return true;
  }
  return false;
}

/// Outside by more than a place in a wall's plane.
bool lies_outside(const Site& site, const GeometryAccess& access, const glm::dvec3& place) {
  constexpr double aside_m = 0.1;
  for (const glm::dvec2& aside : {glm::dvec2(0, 0), {-1, 0}, {1, 0}, {0, -1}, {0, 1}})
    if (!site.is_outside(access, place + glm::dvec3(aside * aside_m, before_point_m))) return false;
  return true;
}

std::string outside_text(EmphasisKind kind) {
  return kind == EmphasisKind::final_exit
             ? ""
             : "no luminaire of the building is near to it there; is its position right?";
}

/// What is wrong with a point near the building: kind and message.
std::optional<std::pair<const char*, std::string>> fitted_wrong(const Site& site,
                                                                const GeometryAccess& access,
                                                                const EmphasisPoint& point) {
  const glm::dvec3 up(0, 0, 1);
  const glm::dvec3 before = point.position + point.facing.value_or(up) * before_point_m;
  const std::string at = ", at " + place_text(point.position);
  if (site.building.in_solid(access, before, furniture_of(site)))
    return {{"inside", "lies inside a wall or body" + at +
                           ": no luminaire is near to it there; move it out"}};
  if (lies_outside(site, access, point.position)) {
    const std::string advice = outside_text(point.kind);
    if (advice.empty()) return std::nullopt;
    return {{"outside", "lies outside the building" + at + ": " + advice}};
  }
  const auto floor = solid_ahead(site, access, before, -up, floor_far_below_m);
  const double height =
      floor ? static_cast<double>(floor->distance_m) - (before - point.position).z : 0;
  const bool equipment = is_equipment(point.kind);
  const double most = equipment ? reach_m : mark_height_m;
  if (height > most)
    return {{"height", fmt::format("lies {} above what is below it{}: {}", length_text(height), at,
                                   equipment ? "nobody reaches it there; is its z in metres above "
                                               "the floor?"
                                             : "give it the height of the floor")}};
  if (equipment && height > stands_m && !solid_around(site, access, before, hung_m))
    return {{"floating", fmt::format("hangs in the air{}: no wall or body is within {} of it; move "
                                     "it to what it hangs on",
                                     at, length_text(hung_m))}};
  const glm::dvec3 waist = point.position + up * std::max(0.0, 1 - height);
  if (is_door(point.kind) && !solid_around(site, access, waist, door_wall_m))
    return {{"floating", fmt::format("is a door{}, and no wall is within {} of it: is its position "
                                     "right?",
                                     at, length_text(door_wall_m))}};
  if (!point.facing) return std::nullopt;
  if (equipment && std::abs(point.facing->z) > 0.7)
    return {{"blind",
             "has a front that looks up or down: its vertical illuminance is asked for; "
             "'facing' is the direction out of the wall"}};
  if (solid_ahead(site, access, before, *point.facing, shut_front_m, false))
    return {{"blind", fmt::format("has a front that faces a wall less than {} before it{}: turn "
                                  "'facing' round; it looks out of the wall",
                                  length_text(shut_front_m), at)}};
  return std::nullopt;
}

}  // namespace

void inspect_emphasis(const Site& site, Findings& out) {
  const auto& points = site.scene.emphasis;
  std::vector<std::optional<Finding>> found(points.size());
  site.building.each(points.size(), [&](const GeometryAccess& access, size_t i) {
    const EmphasisPoint& point = points[i];
    const std::string name = "point of emphasis \"" + point.name + "\"";
    if (auto far = site.remote.told(name, point.position)) {
      found[i] = Finding{Severity::error, "far", {point.place, *far}};
    } else if (auto wrong = fitted_wrong(site, access, point)) {
      found[i] =
          Finding{Severity::warning, wrong->first, {point.place, name + " " + wrong->second}};
    }
  });
  for (auto& finding : found)
    if (finding) out.push_back(std::move(*finding));
}

}  // namespace luxodus
