#include "scenes/transport/lines.hpp"

namespace luxodus {

std::vector<double> direct_by_emitter(const CompiledScene& scene, const GeometryAccess& access,
                                      const Vec3& point, const Vec3& normal,
                                      const DirectOptions& options) {
  return with_resolver(scene, access, [&](auto resolver) {
    std::vector<double> lux;
    const Vec3 from = offset_ray(point, normal, scene.least_offset_m);
    for (const CompiledEmitter& emitter : scene.emitters)
      lux.push_back(direct_from(scene, emitter, from, normal, options, resolver).illuminance_lx);
    return lux;
  });
}

double clear_share(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                   const Vec3& to) {
  return with_resolver(scene, access, [&](auto resolver) {
    const Connection line = connect(scene, from, to, glm::normalize(from - to), true);
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
