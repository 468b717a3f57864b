#include "actors/judge/design/wall_probe.hpp"

#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

std::optional<double> wall_distance(const Building& building, const GeometryAccess& access,
                                    const glm::dvec3& from, const glm::dvec3& direction,
                                    double length_m) {
  const CompiledScene& scene = building.scene();
  const auto stop = first_stop(scene, access, building.local(from), Vec3(direction),
                               static_cast<Real>(length_m), [&](const FacedSurface& f) {
                                 return f.surface >= scene.description->objects.size() ||
                                        lets_light_through(f.kind);
                               });
  if (!stop) return std::nullopt;
  return static_cast<double>(stop->distance_m);
}

glm::dvec3 told_place(const glm::dvec3& place) {
  constexpr double parts_of_metre = 1e3;
  return glm::round(place * parts_of_metre) / parts_of_metre + 0.0;
}

glm::dvec3 told_direction(const glm::dvec3& direction) {
  constexpr double parts = 1e6;
  return glm::round(direction * parts) / parts + 0.0;
}

}  // namespace luxodus
