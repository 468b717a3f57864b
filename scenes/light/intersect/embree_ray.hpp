// Converts a ray to Embree's form; private to this room, since it includes Embree. Pure; any
// thread.
#pragma once

#include <embree3/rtcore.h>

#include "scenes/light/intersect/ray.hpp"

namespace luxodus {

inline RTCRayHit to_embree(const Ray& ray) {
  RTCRayHit query;
  query.ray.org_x = static_cast<float>(ray.origin.x);
  query.ray.org_y = static_cast<float>(ray.origin.y);
  query.ray.org_z = static_cast<float>(ray.origin.z);
  query.ray.tnear = 0;
  query.ray.dir_x = static_cast<float>(ray.direction.x);
  query.ray.dir_y = static_cast<float>(ray.direction.y);
  query.ray.dir_z = static_cast<float>(ray.direction.z);
  query.ray.time = 0;
  query.ray.tfar = static_cast<float>(ray.length);
  query.ray.mask = 0xFFFFFFFFu;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace luxodus
