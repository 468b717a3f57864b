// Inspects the shapes of measurement planes: nearly horizontal, nearly vertical, nearly
// rectangular, slanted above the floor of a route, of an implausible size, or with splinters for
// cells.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// A plane tilted by less than the first [deg], with a rise of more than the second [m], which
/// rounding does not explain, was meant horizontal or vertical.
constexpr double slight_tilt_deg = 5;
constexpr double slight_rise_m = 2e-3;
/// Planes along ramps and raked floors are tilted: tolerance of the heights of their corners above
/// the floor [m].
constexpr double along_floor_m = 2e-3;
/// A smaller plane is smaller than a hand: it is in millimetres [m].
constexpr double min_plane_m = 0.1;
/// Light on a floor is measured on a horizontal plane. One above a route, at most this high at its
/// lower end, and tilted by more than slight_tilt_deg, was meant to be horizontal; from the second
/// angle on it belongs to a wall.
constexpr double on_route_m = 0.5;
constexpr double steepest_floor_deg = 60;
/// Over stairs a plane follows the floor in steps.
constexpr double follows_share = 0.5;
/// Aspect ratio of splinter cells, which would be nearly square with their numbers swapped.
constexpr double splinter = 5;
constexpr double nearly_square = 2;

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

/// Whether a plane follows a floor with the same tilt, within `slack_m`.
bool follows_floor(const Site& site, const PlaneMeasure& plane, double slack_m = along_floor_m) {
  std::vector<double> heights;
  site.building.each(1, [&](const GeometryAccess& access, size_t) {
    for (const glm::dvec2& at : {glm::dvec2(0.1, 0.1), {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}}) {
      const glm::dvec3 place = plane.corner + plane.edge_u * at.x + plane.edge_v * at.y;
      const auto below = solid_ahead(site, access, place + glm::dvec3(0, 0, 1e-3),
                                     glm::dvec3(0, 0, -1), floor_below_m, false);
      if (below) heights.push_back(static_cast<double>(below->distance_m));
    }
  });
  if (heights.size() < 4) return false;
  const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
  return *most - *least < slack_m;
}

/// The route or area above whose floor a plane lies.
std::optional<std::string> judged_floor(const SceneDescription& scene, const PlaneMeasure& plane) {
  const glm::dvec3 middle = plane.corner + 0.5 * (plane.edge_u + plane.edge_v);
  const double low = plane.corner.z + std::min(0.0, plane.edge_u.z) + std::min(0.0, plane.edge_v.z);
  for (const EscapeRoute& route : scene.routes) {
    if (!is_level(route) || !in_plan_of(route, glm::dvec2(middle))) continue;
    if (std::abs(low - route.path.front().z) <= on_route_m) return "route \"" + route.name + "\"";
  }
  for (const AssessedArea& area : scene.open_areas)
    if (in_plan_of(area, glm::dvec2(middle)) && std::abs(low - area.z_m) <= on_route_m)
      return "open area \"" + area.name + "\"";
  return std::nullopt;
}

/// Reports splinter cells that would not be splinters with their numbers swapped.
std::optional<std::string> splintered(const PlaneMeasure& plane) {
  const double u = glm::length(plane.edge_u), v = glm::length(plane.edge_v);
  const auto ratio = [](double a, double b) { return std::max(a, b) / std::min(a, b); };
  const double across = u / plane.cells_u, along = v / plane.cells_v;
  if (ratio(across, along) < splinter ||
      ratio(u / plane.cells_v, v / plane.cells_u) > nearly_square)
    return std::nullopt;
  return fmt::format(
      "has cells of {} by {}, which smear its minimum and its uniformity: swap the "
      "two numbers of 'cells', {} along edge_u and {} along edge_v",
      length_text(across), length_text(along), plane.cells_v, plane.cells_u);
}

/// Reports edges that differ slightly from what was probably meant.
std::optional<std::string> slanted(const Site& site, const PlaneMeasure& plane) {
  const glm::dvec3 u = glm::normalize(plane.edge_u), v = glm::normalize(plane.edge_v);
  const glm::dvec3 normal = glm::normalize(glm::cross(u, v));
  const double length_u = glm::length(plane.edge_u), length_v = glm::length(plane.edge_v);
  const double from_level = degrees(std::acos(std::min(1.0, std::abs(normal.z))));
  const double from_upright = 90 - from_level;
  const double rise = std::max(std::abs(plane.edge_u.z), std::abs(plane.edge_v.z));
  const double lean = std::max(length_u, length_v) * std::abs(normal.z);
  if (from_level < slight_tilt_deg && rise > slight_rise_m && !follows_floor(site, plane))
    return fmt::format(
        "is tilted by {:.2g} degrees, its edges rise by {}: give 'edge_u' and "
        "'edge_v' a z of 0 if it is meant to be level",
        from_level, length_text(rise));
  const auto floor = judged_floor(site.scene, plane);
  if (from_level >= slight_tilt_deg && from_level < steepest_floor_deg && floor &&
      !follows_floor(site, plane, follows_share * rise))
    return fmt::format(
        "is tilted by {:.2g} degrees over the level floor of {}: light on a floor is measured on a "
        "level plane, and this one gets another; give 'edge_u' and 'edge_v' a z of 0",
        from_level, *floor);
  if (from_upright < slight_tilt_deg && lean > slight_rise_m)
    return fmt::format(
        "leans by {:.2g} degrees from the upright: give one edge a z of 0 and the "
        "other that alone if it is meant to be upright",
        from_upright);
  const double skew = degrees(std::asin(std::min(1.0, std::abs(glm::dot(u, v)))));
  const double aside = std::min(length_u, length_v) * std::abs(glm::dot(u, v));
  if (skew < slight_tilt_deg && aside > slight_rise_m)
    return fmt::format(
        "is no rectangle: its edges meet at {:.4g} degrees; is one of their numbers "
        "mistyped?",
        90 - skew);
  return std::nullopt;
}

}  // namespace

void inspect_plane_shapes(const Site& site, Findings& out) {
  for (const PlaneMeasure& plane : site.scene.planes) {
    const std::string name = "plane \"" + plane.name + "\" ";
    const double u = glm::length(plane.edge_u), v = glm::length(plane.edge_v);
    if (std::max(u, v) < min_plane_m) {
      out.push_back({Severity::warning,
                     "unit",
                     {plane.place, fmt::format("{}is {} x {} large: its edges are in metres", name,
                                               length_text(u), length_text(v))}});
    } else if (const auto what = slanted(site, plane)) {
      out.push_back({Severity::warning, "turned", {plane.place, name + *what}});
    } else if (const auto cells = splintered(plane)) {
      out.push_back({Severity::warning, "plane", {plane.place, name + *cells}});
    }
  }
}

}  // namespace luxodus
