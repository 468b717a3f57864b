// Direct light at a point, without chance: every emitter is cut into parts, each part is connected
// by a shadow ray, and the photometric web, the cosine law and the media say what arrives.
// Regulations judge this part alone. Collimated beams have no density of directions and are left to
// the traced part, as is light that a refracting solid or a mirror has turned. Accuracy: midpoint
// rule on parts no wider than 1/16 of their own distance, less in dense media and where the
// receiver's horizon cuts them, as far as the cap on their number allows.
#pragma once

#include <algorithm>
#include <vector>

#include "scenes/geometry/real.hpp"
#include "scenes/transport/connect.hpp"
#include "scenes/transport/emission.hpp"

namespace luxodus {

struct DirectLight {
  std::vector<double> illuminance_lx;  // per source group
  std::vector<double> fluence_lm_m2;   // per source group, all directions alike
  double total_lx() const {
    double sum = 0;
    for (const double e : illuminance_lx) sum += e;
    return sum;
  }
  double total_fluence() const {
    double sum = 0;
    for (const double e : fluence_lm_m2) sum += e;
    return sum;
  }
};

struct DirectOptions {
  bool media = true;  // false: as in clear air (what regulations calculate)
  double part_share = 1.0 / 16;
};

namespace limits {
inline constexpr size_t direct_parts = 8192;  // of one emitter seen from one place
inline constexpr int direct_points = 2048;    // of one that is no rectangle
}  // namespace limits

/// A piece of an emitter that is small as seen from a place, and its share of the power.
struct EmitterPart {
  EmissionPoint point;
  double share = 1;
};

/// Where an emitter is seen from: what decides how finely it is cut.
struct Viewpoint {
  Vec3 place;
  Vec3 normal;            // of the receiver; light from below its horizon does not count
  double sigma_t = 0;     // mean extinction on the way to the emitter [1/m]
  double part_share = 0;  // width over distance of a part
};
std::vector<EmitterPart> emitter_parts(const CompiledScene& scene, const CompiledEmitter& emitter,
                                       const Viewpoint& from);

/// Mean extinction on the straight way from a place to an emitter [1/m], in the band that matters
/// most to the eye; 0 in clear air.
template <class Resolver>
double mean_extinction(const CompiledScene& scene, const CompiledEmitter& emitter,
                       const Vec3& place, Resolver& resolver) {
  if (scene.features.media == MediaNeed::none) return 0;
  const Vec3 target = emitter.kind == EmitterKind::mesh ? emitter.corners[0] : emitter.origin;
  const Real distance = glm::length(target - place);
  if (!(distance > 0)) return 0;
  const Vec3 direction = (target - place) / distance;
  return optical_depth<MediaNeed::general>(scene.media, scene.bands.count() / 2, place, direction,
                                           distance, resolver) /
         static_cast<double>(distance);
}

/// Light from one emitter.
struct DirectFromEmitter {
  double illuminance_lx = 0;
  double fluence_lm_m2 = 0;
};

template <class Resolver>
DirectFromEmitter direct_from(const CompiledScene& scene, const CompiledEmitter& emitter,
                              const Vec3& point, const Vec3& normal, const DirectOptions& options,
                              Resolver& resolver) {
  DirectFromEmitter out;
  if (emitter.distribution == Distribution::collimated) return out;
  const double sigma_t = options.media ? mean_extinction(scene, emitter, point, resolver) : 0;
  const int bands = scene.bands.count();
  for (const EmitterPart& part :
       emitter_parts(scene, emitter, {point, normal, sigma_t, options.part_share})) {
    const Connection c = connect(scene, point, part.point.position, part.point.axis,
                                 emitter.kind != EmitterKind::volume);
    if (!(c.distance > 0)) continue;
    const Real density = directional_density(emitter, part.point, -c.ray.direction, resolver);
    const Real cosine = glm::dot(normal, c.ray.direction);
    if (density <= 0) continue;
    // Below the horizon of the point only the fluence counts, and a line into the surface is no
    // line.
    double lumens = 0;
    double solid = -1;
    for (int b = 0; b < bands; ++b) {
      const double power = emitter.power_w[static_cast<size_t>(b)] * scene.bands[b].lm_per_w;
      if (power <= 0) continue;
      if (solid < 0 || scene.features.surfaces)
        solid = solid_transmittance(scene, c.ray, c.ray.length, b, resolver);
      if (solid == 0) break;
      const double medium =
          options.media ? medium_transmittance(scene, c.ray, c.distance, b, resolver) : 1;
      lumens += power * solid * medium;
    }
    const auto distance = static_cast<double>(c.distance);
    const double e = lumens * static_cast<double>(density) / (distance * distance) * part.share;
    out.fluence_lm_m2 += e;
    if (cosine > 0) out.illuminance_lx += e * static_cast<double>(cosine);
  }
  return out;
}

/// Light from all emitters at a point [local coordinates] with a normal.
template <class Resolver>
DirectLight direct_light(const CompiledScene& scene, const Vec3& point, const Vec3& normal,
                         const DirectOptions& options, Resolver& resolver) {
  DirectLight out;
  out.illuminance_lx.assign(scene.groups.size(), 0);
  out.fluence_lm_m2.assign(scene.groups.size(), 0);
  const Vec3 from = offset_ray(point, normal, scene.least_offset_m);
  for (const CompiledEmitter& emitter : scene.emitters) {
    const DirectFromEmitter d = direct_from(scene, emitter, from, normal, options, resolver);
    out.illuminance_lx[static_cast<size_t>(emitter.group)] += d.illuminance_lx;
    out.fluence_lm_m2[static_cast<size_t>(emitter.group)] += d.fluence_lm_m2;
  }
  return out;
}

}  // namespace luxodus
