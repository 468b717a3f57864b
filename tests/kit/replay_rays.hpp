// Rays answered by Embree alone: the yardstick that benchmarks hold the tracer against. Nothing of
// a hit is read but what proves that the work was done. Any thread.
#pragma once

#include <cstdint>
#include <span>

#include "scenes/light/intersect/embree_ray.hpp"
#include "scenes/light/intersect/embree_scene.hpp"

namespace luxodus::test {

/// Calls rtcIntersect1 for every ray, in order; the sum of the triangles hit.
inline uint64_t replay_rays(const CellScene& scene, std::span<const Ray> rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  uint64_t sum = 0;
  for (const Ray& ray : rays) {
    RTCRayHit query = to_embree(ray);
    rtcIntersect1(scene.get(), &context, &query);
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) sum += query.hit.primID;
  }
  return sum;
}

}  // namespace luxodus::test
