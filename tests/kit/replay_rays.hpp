// Rays answered by Embree alone: the reference for benchmarks of the tracer. Only a checksum of the
// hits is kept, as proof of the work. Any thread.
#pragma once

#include <cstdint>
#include <span>

#include "scenes/light/intersect/embree_ray.hpp"
#include "scenes/light/intersect/embree_scene.hpp"

namespace luxodus::test {

/// Calls rtcIntersect1 for every ray, in order; returns the sum of the hit triangles' numbers.
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
