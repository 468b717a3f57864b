// Bounding boxes of a scene's flames: a line that misses them needs no walk through media. Plain
// values; any thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scenes/light/intersect/ray.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/media_bounds.hpp"

namespace luxodus {

/// An emitting medium and its bounding box [m].
struct FlameBox {
  uint32_t emitter = 0;
  Vec3 low{0}, high{0};

  /// Whether the first `length` [m] of the ray may pass through it.
  bool may_meet(const Ray& ray, Real length) const {
    Real from = 0, to = length;
    for (int k = 0; k < 3; ++k) {
      if (ray.direction[k] == 0) {
        if (ray.origin[k] < low[k] || ray.origin[k] > high[k]) return false;
        continue;
      }
      const Real to_low = (low[k] - ray.origin[k]) / ray.direction[k];
      const Real to_high = (high[k] - ray.origin[k]) / ray.direction[k];
      from = std::max(from, std::min(to_low, to_high));
      to = std::min(to, std::max(to_low, to_high));
    }
    return from <= to;
  }
};

/// The boxes of all emitting media, ascending by emitter.
inline std::vector<FlameBox> flame_boxes(const CompiledScene& scene) {
  constexpr double everywhere_m = 1e9;
  std::vector<FlameBox> out;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const CompiledEmitter& e = scene.emitters[i];
    if (e.kind != EmitterKind::volume) continue;
    const Medium* medium = &scene.description->media[e.medium];
    const Bounds box =
        media_bounds({&medium, 1}, {glm::dvec3(-everywhere_m), glm::dvec3(everywhere_m)});
    const Vec3 rounding(scene.diagonal_m * 0x1p-16_r);
    out.push_back({i, Vec3(box.low - scene.local_origin) - rounding,
                   Vec3(box.high - scene.local_origin) + rounding});
  }
  return out;
}

}  // namespace luxodus
