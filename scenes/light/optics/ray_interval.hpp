// Intervals of a ray, and its intersection with an axis-aligned box. Distances along the ray [m] in
// double. Half-open throughout: a body owns its lower faces, so that bodies that share a face
// neither overlap nor leave a gap for rays within that face. Plain values; any thread.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace luxodus {

/// Points t0 <= t < t1 of a ray.
struct RayInterval {
  double t0 = 0;
  double t1 = 0;
  bool empty() const { return !(t0 < t1); }
};

inline RayInterval common(const RayInterval& a, const RayInterval& b) {
  return {std::max(a.t0, b.t0), std::min(a.t1, b.t1)};
}

/// The part of `within` between two planes low <= x < high across one axis. A ray without motion
/// along the axis (d == 0) is inside everywhere or nowhere; any other d, even 1e-45, has a finite
/// inverse in double.
inline RayInterval between_planes(double low, double high, double o, double d, RayInterval within) {
  if (d == 0) return o >= low && o < high ? within : RayInterval{0, 0};
  const double inverse = 1 / d;
  const double to_low = (low - o) * inverse;
  const double to_high = (high - o) * inverse;
  return common(within, d > 0 ? RayInterval{to_low, to_high} : RayInterval{to_high, to_low});
}

/// The part of `within` inside the box [low, high).
inline RayInterval inside_box(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& o,
                              const glm::dvec3& d, RayInterval within) {
  for (int k = 0; k < 3 && !within.empty(); ++k) {
    within = between_planes(low[k], high[k], o[k], d[k], within);
  }
  return within;
}

}  // namespace luxodus
