// Planes of measurement as they are written: nearly level, nearly upright, nearly rectangular, or
// of a size that nothing is measured on.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/inspect/site.hpp"

namespace luxodus {

namespace {

/// A plane that is tilted by less than this, and by more than rounding explains, was meant level or
/// upright [deg], and ends so much too high or too low [m].
constexpr double slight_tilt_deg = 5;
constexpr double slight_rise_m = 2e-3;
/// Ramps and rakes are tilted: so alike are the heights of a plane's corners above its floor [m].
constexpr double along_floor_m = 2e-3;
/// Smaller than a hand: millimetres [m].
constexpr double min_plane_m = 0.1;

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

/// Whether a plane follows a floor that is tilted as it is.
bool follows_floor(const Site& site, const PlaneMeasure& plane) {
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
  return *most - *least < along_floor_m;
}

/// What of its edges is not as it was meant.
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
    }
  }
}

}  // namespace luxodus
