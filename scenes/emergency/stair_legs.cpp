#include "scenes/emergency/stair_legs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxodus {

namespace {

constexpr double min_climb_deg = 15;
/// Riser height if only a route shows that there are stairs [m].
constexpr double usual_rise_m = 0.17;

}  // namespace

bool climbs_stairs(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  return std::abs(way.z) >
         std::tan(min_climb_deg * std::numbers::pi / 180) * glm::length(glm::dvec2(way));
}

std::string flight_name(const EscapeRoute& route, size_t number) {
  return route.name + ", flight " + std::to_string(number);
}

std::vector<glm::dvec3> treads_on_line(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 low = from.z <= to.z ? from : to, high = from.z <= to.z ? to : from;
  const int n = std::max(1, static_cast<int>(std::lround((high.z - low.z) / usual_rise_m)));
  std::vector<glm::dvec3> out;
  for (int i = 0; i < n; ++i)
    out.push_back(low + (high - low) * (n > 1 ? static_cast<double>(i) / (n - 1) : 0.5));
  return out;
}

}  // namespace luxodus
