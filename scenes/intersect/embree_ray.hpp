// A ray as Embree takes it; of this room only, since it includes Embree.
#pragma once

#include <embree3/rtcore.h>

#include "scenes/intersect/ray.hpp"

namespace luxodus {

inline RTCRayHit to_embree(const Ray& ray) {
  RTCRayHit query;
  query.ray.org_x = ray.origin.x;
  query.ray.org_y = ray.origin.y;
  query.ray.org_z = ray.origin.z;
  query.ray.tnear = 0;
  query.ray.dir_x = ray.direction.x;
  query.ray.dir_y = ray.direction.y;
  query.ray.dir_z = ray.direction.z;
  query.ray.time = 0;
  query.ray.tfar = ray.length;
  query.ray.mask = 0xFFFFFFFFu;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace luxodus
