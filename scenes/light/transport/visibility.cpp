#include "scenes/light/transport/visibility.hpp"

#include <cmath>

#include "scenes/light/transport/direct.hpp"

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
                   const Vec3& to, int body) {
  return with_resolver(scene, access, [&](auto resolver) {
    const ShadowRay line = connect(scene, from, to, glm::normalize(from - to), true);
    return solid_transmittance(scene, line.ray, line.ray.length, scene.bands.count() / 2, resolver,
                               body);
  });
}

double depth_between(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                     const Vec3& to, double wavelength_nm) {
  const Real length = glm::length(to - from);
  if (scene.features.media == MediaNeed::none || !(length > 0)) return 0;
  const auto of_band = [&](int band) {
    return with_resolver(scene, access, [&](auto resolver) {
      return optical_depth<MediaNeed::general>(scene.media, band, from, (to - from) / length,
                                               length, resolver);
    });
  };
  // A quantity proportional to 1/wavelength takes its mean over a band at this wavelength of the
  // band; between two of those, a power of the wavelength is linear in logarithms.
  Spectrum inverse;
  for (int i = 0; i < spectrum_samples; ++i)
    inverse.value[static_cast<size_t>(i)] = 1 / Spectrum::wavelength_nm(i);
  const auto middle_nm = [&](int band) { return 1 / scene.bands.average(inverse, band); };
  const int last = scene.bands.count() - 1;
  int high = 0;
  while (high < last && middle_nm(high) < wavelength_nm) ++high;
  if (high == 0 || middle_nm(high) < wavelength_nm) return of_band(high);
  const double a = of_band(high - 1), b = of_band(high);
  if (!(a > 0 && b > 0)) return b;
  const double share = std::log(wavelength_nm / middle_nm(high - 1)) /
                       std::log(middle_nm(high) / middle_nm(high - 1));
  return a * std::pow(b / a, share);
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
