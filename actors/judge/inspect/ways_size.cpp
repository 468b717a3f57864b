#include "actors/judge/inspect/ways_size.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/emergency/rules.hpp"

namespace luxodus {

namespace {

/// Memory of a point of calculation [bytes]: its place, and the light of each luminaire.
double bytes_of_point(const SceneDescription& scene) {
  return sizeof(LitPoint) +
         sizeof(double) * static_cast<double>(emergency_luminaires(scene).size());
}

/// Points of calculation of a route: lines along its whole length (rules.hpp).
double points_of_route(const EscapeRoute& route) {
  constexpr double lines_of_strip = 6;
  const double strips = std::ceil(route.width_m / 2), across = route.width_m / route_grid_m + 2;
  return length_of(route) / route_grid_m * (strips * lines_of_strip + across);
}

void tell_size(const std::string& subject, const SourcePlace& place, const std::string& size,
               double points, const SceneDescription& scene, Findings& out) {
  const double bytes = points * bytes_of_point(scene);
  if (!(bytes > limits::judged_light_bytes)) return;
  out.push_back({Severity::error,
                 "unit",
                 {place, fmt::format("{} is {}: its {:.2g} points of calculation take {:.3g} GB of "
                                     "memory; lengths are in metres, and a larger building is "
                                     "judged in parts",
                                     subject, size, points, bytes / 1e9)}});
}

}  // namespace

std::vector<glm::dvec3> places_along(const EscapeRoute& route, double spacing_m) {
  return along(route, 0, std::max(spacing_m, length_of(route) / limits::inspected_places));
}

std::vector<glm::dvec3> places_within(const EscapeRoute& route, double half_width_m,
                                      double spacing_m) {
  const double area_m2 = 2 * half_width_m * length_of(route);
  return within(route, half_width_m,
                std::max({spacing_m, std::sqrt(area_m2 / limits::inspected_places),
                          length_of(route) / limits::inspected_places}));
}

double spacing_within(const AssessedArea& area, double spacing_m, size_t most) {
  const glm::dvec2 size = plan_box_of(area).size();
  const auto count = static_cast<double>(most);
  return std::max({spacing_m, std::sqrt(size.x * size.y / count), size.x / count, size.y / count});
}

std::vector<glm::dvec3> places_within(const AssessedArea& area, double border_m, double spacing_m,
                                      size_t most) {
  return within(area, border_m, spacing_within(area, spacing_m, most));
}

std::vector<Walker> steps_along(const EscapeRoute& route, double spacing_m) {
  return walkers(route, std::max(spacing_m, length_of(route) / limits::inspected_steps));
}

void inspect_way_sizes(const SceneDescription& scene, Findings& out) {
  for (const EscapeRoute& route : scene.routes)
    tell_size("route \"" + route.name + "\"", route.place, length_text(length_of(route)) + " long",
              points_of_route(route), scene, out);
  const auto tell_area = [&](const char* word, const AssessedArea& area) {
    const glm::dvec2 size = plan_box_of(area).size();
    tell_size(fmt::format("{} \"{}\"", word, area.name), area.place,
              length_text(size.x) + " by " + length_text(size.y),
              (size.x / area_grid_m + 1) * (size.y / area_grid_m + 1), scene, out);
  };
  for (const AssessedArea& area : scene.open_areas) tell_area("open area", area);
  for (const AssessedArea& area : scene.task_areas) tell_area("task area", area);
}

}  // namespace luxodus
