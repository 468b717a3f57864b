#include "scenes/transport/visibility.hpp"

#include "scenes/transport/direct.hpp"

namespace luxodus {

std::vector<DirectFromEmitter> direct_lights(const CompiledScene& scene,
                                             const GeometryAccess& access, const Vec3& point,
                                             const Vec3& normal, const DirectOptions& options) {
  return with_resolver(scene, access, [&](auto resolver) {
    return DirectSum<decltype(resolver)>(scene, point, normal, options, resolver).by_emitter();
  });
}

std::vector<double> direct_by_emitter(const CompiledScene& scene, const GeometryAccess& access,
                                      const Vec3& point, const Vec3& normal,
                                      const DirectOptions& options) {
  std::vector<double> lux;
  for (const DirectFromEmitter& light : direct_lights(scene, access, point, normal, options))
    lux.push_back(light.illuminance_lx);
  return lux;
}

std::vector<ArrivingLight> direct_arrivals(const CompiledScene& scene, const GeometryAccess& access,
                                           const Vec3& point, const Vec3& normal,
                                           const DirectOptions& options) {
  return with_resolver(scene, access, [&](auto resolver) {
    return DirectSum<decltype(resolver)>(scene, point, normal, options, resolver).arriving();
  });
}

double clear_share(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                   const Vec3& to) {
  return with_resolver(scene, access, [&](auto resolver) {
    const ShadowRay line = connect(scene, from, to, glm::normalize(from - to), true);
    return solid_transmittance(scene, line.ray, line.ray.length, scene.bands.count() / 2, resolver);
  });
}

std::optional<MetSurface> next_surface(const CompiledScene& scene, const GeometryAccess& access,
                                       const Vec3& from, const Vec3& direction, Real length_m) {
  return with_resolver(scene, access, [&](auto resolver) -> std::optional<MetSurface> {
    Ray ray{from, direction};
    ray.length = length_m;
    const Hit hit = resolver.nearest(ray);
    if (!hit.found()) return std::nullopt;
    return MetSurface{hit.distance, glm::dot(hit.triangle->unit_normal(), direction) < 0,
                      hit.triangle->surface};
  });
}

}  // namespace luxodus
