#include "actors/judge/design/stair_flights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Steepness above which a leg is no ramp [deg]; ramps have up to 10.
constexpr double min_climb_deg = 15;
/// Riser height if only a route shows that there are stairs [m].
constexpr double usual_rise_m = 0.17;
/// Largest distance between a route and the stairs that it climbs [m].
constexpr double same_stairs_m = 1;

bool climbs(const glm::dvec3& way) {
  return std::abs(way.z) >
         std::tan(min_climb_deg * std::numbers::pi / 180) * glm::length(glm::dvec2(way));
}

/// Whether a leg of a route leads over stairs.
bool runs_over(const EscapeRoute& leg, const StairFlight& stairs) {
  const glm::dvec3 middle = (stairs.lowest + stairs.highest) / 2.0;
  const glm::dvec3 a = leg.path[0], way = leg.path[1] - a;
  const double square = glm::dot(glm::dvec2(way), glm::dvec2(way));
  if (!in_plan_of(leg, glm::dvec2(middle)) || !(square > 0)) return false;
  const double t = glm::dot(glm::dvec2(middle - a), glm::dvec2(way)) / square;
  return std::abs(a.z + std::clamp(t, 0.0, 1.0) * way.z - middle.z) < same_stairs_m;
}

}  // namespace

std::vector<StairFlight> stair_flights_of(const SceneDescription& scene,
                                          const DesignSettings& design) {
  std::vector<StairFlight> out = design.stair_flights;
  for (const EscapeRoute& route : scene.routes) {
    int number = 0;
    for (size_t i = 1; i < route.path.size(); ++i) {
      EscapeRoute leg = route;
      leg.path = {route.path[i - 1], route.path[i]};
      if (!climbs(leg.path[1] - leg.path[0])) continue;
      ++number;
      if (std::any_of(design.stair_flights.begin(), design.stair_flights.end(),
                      [&](const StairFlight& stairs) { return runs_over(leg, stairs); }))
        continue;
      StairFlight stairs{route.name + ", flight " + std::to_string(number), leg.path[0],
                         leg.path[1], 1};
      if (stairs.lowest.z > stairs.highest.z) std::swap(stairs.lowest, stairs.highest);
      stairs.treads = std::max(
          1, static_cast<int>(std::lround((stairs.highest.z - stairs.lowest.z) / usual_rise_m)));
      out.push_back(std::move(stairs));
    }
  }
  return out;
}

std::vector<glm::dvec3> treads_of(const StairFlight& stairs) {
  std::vector<glm::dvec3> out;
  for (int i = 0; i < stairs.treads; ++i) {
    const double t = stairs.treads > 1 ? static_cast<double>(i) / (stairs.treads - 1) : 0.5;
    out.push_back(stairs.lowest + (stairs.highest - stairs.lowest) * t);
  }
  return out;
}

}  // namespace luxodus
