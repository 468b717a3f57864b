// Where a ray that leaves a surface starts: far enough out that rounding cannot make it hit the
// surface it left, and no farther. The distance grows with the position, counted in units in the
// last place (the idea of Wächter and Binder, "A Fast and Robust Method for Avoiding
// Self-Intersection", Ray Tracing Gems ch. 6). Promise: for points interpolated on a triangle whose
// extent is at most 16 times its distance from the origin, or at most 50 m, the start lies on the
// normal's side of the exact plane, 1e-3 to 1e5 m out. Any thread, no state.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace luxodus {

namespace offset_limits {
/// Units in the last place per unit of the normal: 0.1 mm at 10 m, 0.5 mm at 100 m, so a wall of 1
/// mm is not stepped through. The paper's 256 would step 2 mm at 100 m; at 16 the error of
/// intersecting a 100 m triangle close to the origin shows.
inline constexpr float ulps_per_normal = 64.0F;
/// Added where the normal has the least component: interpolation errs by up to 3 ulps in every
/// coordinate, and an oblique plane whose small component meets a large coordinate would otherwise
/// gain nothing.
inline constexpr float least_ulps = 4.0F;
/// Distance per unit of the normal where ulps are too small to count [m]: covers triangles that
/// reach 50 m out while the point itself is near zero.
inline constexpr float near_zero_m = 0x1p-16F;
}  // namespace offset_limits

/// One coordinate of offset_ray.
inline float offset_coordinate(float position, float normal) {
  if (normal == 0.0F) return position;
  const float fixed = position + normal * offset_limits::near_zero_m;
  const uint32_t ulps = static_cast<uint32_t>(std::fabs(normal) * offset_limits::ulps_per_normal +
                                              offset_limits::least_ulps);
  // Bit patterns of one sign are ordered as their magnitudes: outwards adds, towards zero
  // subtracts.
  const uint32_t bits = std::bit_cast<uint32_t>(position);
  const bool away_from_zero = (normal > 0.0F) == (position >= 0.0F);
  const bool crosses_zero = !away_from_zero && (bits & 0x7fffffffU) <= ulps;
  if (crosses_zero) return fixed;
  const float stepped = std::bit_cast<float>(away_from_zero ? bits + ulps : bits - ulps);
  return std::fabs(stepped - position) > std::fabs(fixed - position) ? stepped : fixed;
}

/// Start of a ray that leaves `position` [m] to the side its unit `normal` points to.
inline glm::vec3 offset_ray(const glm::vec3& position, const glm::vec3& normal) {
  return {offset_coordinate(position.x, normal.x), offset_coordinate(position.y, normal.y),
          offset_coordinate(position.z, normal.z)};
}

}  // namespace luxodus
