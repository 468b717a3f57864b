#include "scenes/light/transport/emitted_light.hpp"

#include "scenes/light/transport/connect.hpp"

namespace luxodus {

std::vector<EmittedRay> emitted_rays(const CompiledScene& scene, const GeometryAccess& access,
                                     uint32_t emitter, uint64_t seed, int count) {
  const CompiledEmitter& e = scene.emitters[emitter];
  std::vector<EmittedRay> rays;
  with_resolver(scene, access, [&](auto resolver) {
    Random random(seed, RandomStream::layout);
    for (int i = 0; i < count; ++i) {
      random.start(static_cast<uint64_t>(i));
      const EmissionPoint point = emission_point(scene, e, random, resolver);
      rays.push_back({point, emission_direction(e, point, random, resolver)});
    }
  });
  return rays;
}

Real emitted_density(const CompiledScene& scene, const GeometryAccess& access, uint32_t emitter,
                     const EmissionPoint& point, const Vec3& direction) {
  return with_resolver(scene, access, [&](auto resolver) {
    return directional_density(scene.emitters[emitter], point, direction, resolver);
  });
}

double media_share(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                   const Vec3& direction, Real length_m) {
  return with_resolver(scene, access, [&](auto resolver) {
    return medium_transmittance(scene, {from, direction}, length_m, scene.bands.count() / 2,
                                resolver);
  });
}

}  // namespace luxodus
