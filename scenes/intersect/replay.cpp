#include "scenes/intersect/replay.hpp"

#include "scenes/intersect/embree_ray.hpp"

namespace luxodus {

uint64_t replay_rays(const CellScene& scene, std::span<const Ray> rays) {
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

}  // namespace luxodus
