#include "actors/judge/assess/storey_floor.hpp"

#include <algorithm>
#include <cmath>

#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

namespace {

/// Search for a floor: largest depth, and the depth within which a thing may meet its own body [m].
constexpr Real deepest_m = 1000, own_body_m = 0.15_r;
/// A surface this close to the height of a route or an area is its floor: a screed or a step is
/// lower, a desk is higher [m].
constexpr double same_floor_m = 0.5;

bool is_near_a_floor(const SceneDescription& scene, double z) {
  const auto near = [&](double low, double high) {
    return z > low - same_floor_m && z < high + same_floor_m;
  };
  for (const EscapeRoute& route : scene.routes)
    for (size_t i = 1; i < route.path.size(); ++i) {
      const auto [low, high] = std::minmax(route.path[i - 1].z, route.path[i].z);
      if (near(low, high)) return true;
    }
  for (const auto* areas : {&scene.open_areas, &scene.task_areas})
    for (const AssessedArea& area : *areas)
      if (near(area.z_m, area.z_m)) return true;
  return false;
}

std::optional<double> met_below(const Building& building, const GeometryAccess& access,
                                const glm::dvec3& place, Real own_body) {
  const auto& objects = building.scene().description->objects;
  const auto stop =
      first_stop(building.scene(), access, building.local(place), Vec3(0, 0, -1), deepest_m,
                 [&](const FacedSurface& f) {
                   if (f.surface >= objects.size() || lets_light_through(f.kind)) return true;
                   const bool is_back = f.front == (building.turned()[f.surface] != 0);
                   return is_furniture(objects[f.surface]) || (f.distance_m < own_body && is_back);
                 });
  if (!stop) return std::nullopt;
  return place.z - static_cast<double>(stop->distance_m);
}

}  // namespace

std::optional<double> surface_below(const Building& building, const GeometryAccess& access,
                                    const glm::dvec3& thing) {
  return met_below(building, access, thing, own_body_m);
}

std::vector<std::optional<double>> storey_floors(const SceneDescription& scene,
                                                 const Building& building,
                                                 std::span<const glm::dvec3> things) {
  std::vector<std::optional<double>> out(things.size());
  building.each(things.size(), [&](const GeometryAccess& access, size_t i) {
    const auto met = surface_below(building, access, things[i]);
    out[i] = met && is_near_a_floor(scene, *met) ? met : floor_below(scene, things[i]);
  });
  return out;
}

std::optional<double> storey_floor_around(const SceneDescription& scene, const Building& building,
                                          const glm::dvec3& point,
                                          std::span<const glm::dvec3> around) {
  std::vector<std::optional<double>> met(around.size());
  building.each(around.size(), [&](const GeometryAccess& access, size_t i) {
    if (!building.in_solid(access, around[i])) met[i] = met_below(building, access, around[i], 0);
  });
  for (const auto& floor : met)
    if (floor && is_near_a_floor(scene, *floor)) return floor;
  return floor_below(scene, point);
}

}  // namespace luxodus
