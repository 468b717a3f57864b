#include "actors/judge/design/stair_flights.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/emergency/stair_legs.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Largest distance between a route and the stairs that it climbs [m].
constexpr double same_stairs_m = 1;

/// Whether a leg of a route leads over stairs.
bool runs_over(const EscapeRoute& leg, const StairFlight& stairs) {
  const glm::dvec3 middle = (stairs.lowest + stairs.highest) / 2.0;
  const glm::dvec3 a = leg.path[0], way = leg.path[1] - a;
  const double square = glm::dot(glm::dvec2(way), glm::dvec2(way));
  if (!in_plan_of(leg, glm::dvec2(middle)) || !(square > 0)) return false;
  const double t = glm::dot(glm::dvec2(middle - a), glm::dvec2(way)) / square;
  return std::abs(a.z + std::clamp(t, 0.0, 1.0) * way.z - middle.z) < same_stairs_m;
}

bool climbs(const EscapeRoute& route, const StairFlight& stairs) {
  for (size_t i = 1; i < route.path.size(); ++i) {
    EscapeRoute leg = route;
    leg.path = {route.path[i - 1], route.path[i]};
    if (climbs_stairs(leg.path[0], leg.path[1]) && runs_over(leg, stairs)) return true;
  }
  return false;
}

}  // namespace

std::vector<StairFlight> flights_beside_routes(const SceneDescription& scene,
                                               const DesignSettings& design) {
  std::vector<StairFlight> out = design.stair_flights;
  std::erase_if(out, [&](const StairFlight& stairs) {
    return std::any_of(scene.routes.begin(), scene.routes.end(),
                       [&](const EscapeRoute& route) { return climbs(route, stairs); });
  });
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
