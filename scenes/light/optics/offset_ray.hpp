// The origin of a ray that leaves a surface: far enough from it that rounding cannot make the ray
// hit the surface again, and no farther. The offset grows with the position, in units in the last
// place (after Wächter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray
// Tracing Gems ch. 6). Promise: for points interpolated on a triangle whose extent is at most its
// distance from the origin, or at most the size given to `min_offset`, the ray's origin lies on the
// normal's side of the exact plane, and a ray from it to that side does not hit the triangle again.
// Pure functions; any thread.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/sampling.hpp"

namespace luxodus {

namespace offset_limits {
/// Units in the last place per unit of the normal. Together with the next constant this is 0.08 mm
/// at 10 m and 0.6 mm at 100 m, so that a ray does not pass through a wall of 1 mm; the paper's 256
/// would step 2 mm at 100 m.
inline constexpr float ulps_per_normal = 64.0F;
/// Added even if the normal's component is small. Interpolation errs by up to 3 ulps in every
/// coordinate; without this, an oblique plane whose small component meets a large coordinate would
/// get no offset. With 4, one ray in 2e5 still hit its own slightly tilted triangle 100 km out;
/// with 16 none.
inline constexpr float min_ulps = 16.0F;
/// Least offset as a share of the scene's size: near zero, ulps are too small, while triangles
/// still extend far. 0.014 mm in a building of 30 m.
inline constexpr Real min_share = 0x1p-21_r;
}  // namespace offset_limits

/// Least offset in a scene of this size (its diagonal) [m]; it makes a room of a millimetre as
/// precise as one of ten kilometres.
inline Real min_offset(Real size_m) {
  return size_m * offset_limits::min_share;
}

/// One coordinate of offset_ray.
inline float offset_coordinate(float position, float normal, float min_offset_m) {
  const uint32_t bits = std::bit_cast<uint32_t>(position);
  const float wanted = std::fabs(normal) * offset_limits::ulps_per_normal + offset_limits::min_ulps;
  const uint32_t ulps = normal == 0.0F ? 0U : static_cast<uint32_t>(wanted);
  // Bit patterns of one sign are ordered as their magnitudes: outwards adds, towards zero
  // subtracts. A step across zero wraps round to a NaN, which loses the comparison below.
  const bool towards_zero = ((bits ^ std::bit_cast<uint32_t>(normal)) >> 31) != 0;
  const uint32_t mask = 0U - static_cast<uint32_t>(towards_zero);
  const float stepped = std::bit_cast<float>(bits + ((ulps ^ mask) - mask));
  const float fixed = position + normal * min_offset_m;
  const bool farther = std::fabs(stepped - position) > std::fabs(fixed - position);
  return choose(farther, stepped, fixed);
}

/// The offset in double has the size of the one in float: the origin must clear what is stored in
/// float, above all corners, and Embree's rounding. Also, two builds that differ in rounding alone
/// can then be compared.
inline double offset_coordinate(double position, double normal, double min_offset_m) {
  const auto near = static_cast<float>(position);
  const float moved = offset_coordinate(near, static_cast<float>(normal), 0.0F);
  const double stepped = position + (static_cast<double>(moved) - static_cast<double>(near));
  const double fixed = position + normal * min_offset_m;
  return std::fabs(stepped - position) > std::fabs(fixed - position) ? stepped : fixed;
}

/// Start of a ray that leaves `position` [m] to the side its unit `normal` points to.
inline Vec3 offset_ray(const Vec3& position, const Vec3& normal, Real min_offset_m) {
  return {offset_coordinate(position.x, normal.x, min_offset_m),
          offset_coordinate(position.y, normal.y, min_offset_m),
          offset_coordinate(position.z, normal.z, min_offset_m)};
}

/// Largest offset [m] of a position whose coordinates are at most `farthest_m` from zero.
inline double largest_offset(double farthest_m, double min_offset_m) {
  constexpr double ulps = offset_limits::ulps_per_normal + offset_limits::min_ulps;
  return std::max(min_offset_m, farthest_m * ulps * 0x1p-23) * std::sqrt(3.0);
}

}  // namespace luxodus
