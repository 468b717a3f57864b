// Samples a point of a line in a flame, in proportion to the light that it sends back along the
// line. Functions without state; any thread.
#pragma once

#include <cmath>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct FlamePlace {
  double light = 0;  // of the whole line: emission density times transmittance times length [1/m2]
  double density = 0;  // mean of the segment [1/m3]
  Real t = 0;
  bool missed = false;  // the line does not pass through the flame
};

/// Samples the first `length` [m] of the ray. `medium`: the flame. `u`: uniform. Suspends: where
/// the resolver does.
template <class Resolver>
FlamePlace place_in_flame(const CompiledScene& scene, const Ray& ray, Real length, int band,
                          uint32_t medium, double u, Resolver& resolver) {
  FlamePlace chosen;
  double depth = 0;
  for_each_segment(
      scene.media, band, ray.origin, ray.direction, length, resolver, [&](const MediaSegment& s) {
        const double tau = s.sigma_t * s.length;
        for (const EmissionPart& part : s.emission) {
          if (static_cast<uint32_t>(part.medium) != medium) continue;
          const double through = s.sigma_t > 0 ? -std::expm1(-tau) / s.sigma_t : s.length;
          const double light = part.density * std::exp(-depth) * through;
          if (!(light > 0)) continue;
          chosen.light += light;
          const double share = light / chosen.light;
          if (u >= share) {  // reused for each segment: the remainder is uniform
            u = (u - share) / (1 - share);
            continue;
          }
          u /= share;
          const double along =
              s.sigma_t > 0 ? -std::log1p(u * std::expm1(-tau)) / s.sigma_t : u * s.length;
          chosen.density = part.density;
          chosen.t = s.t0 + static_cast<Real>(along);
        }
        depth += tau;
        return depth < 50;
      });
  chosen.missed = !(chosen.light > 0) && depth < 50;
  return chosen;
}

}  // namespace luxodus
