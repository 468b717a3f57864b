// Direct light at a point, without chance: every emitter is cut into parts by its size and
// distance, each part is connected by a shadow ray, and the photometric web, the cosine law and the
// media say what arrives. Regulations judge this part alone. Collimated beams have no density of
// directions and are left to the traced part, as is light that a refracting solid or a mirror has
// turned. Accuracy: parts are no wider than 1/16 of their distance where the cap allows; midpoint
// rule.
#pragma once

#include <algorithm>
#include <vector>

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
inline constexpr int direct_parts_per_side = 48;
inline constexpr int direct_points = 2048;
}  // namespace limits

/// Points of an emitter that stand for it as seen from a place: equal shares of its power.
std::vector<EmissionPoint> emitter_parts(const CompiledScene& scene, const CompiledEmitter& emitter,
                                         const glm::vec3& from, double part_share);

/// Light from one emitter.
struct DirectFromEmitter {
  double illuminance_lx = 0;
  double fluence_lm_m2 = 0;
};

template <class Resolver>
DirectFromEmitter direct_from(const CompiledScene& scene, const CompiledEmitter& emitter,
                              const glm::vec3& point, const glm::vec3& normal,
                              const DirectOptions& options, Resolver& resolver) {
  DirectFromEmitter out;
  if (emitter.distribution == Distribution::collimated) return out;
  const std::vector<EmissionPoint> parts = emitter_parts(scene, emitter, point, options.part_share);
  const int bands = scene.bands.count();
  for (const EmissionPoint& part : parts) {
    const Connection c =
        connect(point, part.position, part.axis, emitter.kind != EmitterKind::volume);
    if (!(c.distance > 0)) continue;
    const float density = directional_density(emitter, part, -c.ray.direction, resolver);
    const float cosine = glm::dot(normal, c.ray.direction);
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
    const double e = lumens * static_cast<double>(density) / (distance * distance) /
                     static_cast<double>(parts.size());
    out.fluence_lm_m2 += e;
    if (cosine > 0) out.illuminance_lx += e * static_cast<double>(cosine);
  }
  return out;
}

/// Light from all emitters at a point [local coordinates] with a normal.
template <class Resolver>
DirectLight direct_light(const CompiledScene& scene, const glm::vec3& point,
                         const glm::vec3& normal, const DirectOptions& options,
                         Resolver& resolver) {
  DirectLight out;
  out.illuminance_lx.assign(scene.groups.size(), 0);
  out.fluence_lm_m2.assign(scene.groups.size(), 0);
  const glm::vec3 from = offset_ray(point, normal);
  for (const CompiledEmitter& emitter : scene.emitters) {
    const DirectFromEmitter d = direct_from(scene, emitter, from, normal, options, resolver);
    out.illuminance_lx[static_cast<size_t>(emitter.group)] += d.illuminance_lx;
    out.fluence_lm_m2[static_cast<size_t>(emitter.group)] += d.fluence_lm_m2;
  }
  return out;
}

}  // namespace luxodus
