// Bounding spheres of emitters, stored for vectorised tests: every segment of every path tests
// which of them it passes near. Immutable once filled; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/intersect/ray.hpp"

namespace luxodus {

class SphereSet {
 public:
  void add(const Vec3& centre, Real radius) {
    x_.push_back(centre.x);
    y_.push_back(centre.y);
    z_.push_back(centre.z);
    radius_.push_back(radius);
  }

  Vec3 centre(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  Real radius(size_t i) const { return radius_[i]; }

  /// Calls visit(i, t, square), ascending, for the spheres that are nearer than `reach` [m] to the
  /// first `end` of the ray. `t`: where the ray is nearest to the centre [m]; `square`: squared
  /// distance there [m2].
  template <class Visit>
  void for_each_near(const Ray& ray, Real end, Real reach, Visit&& visit) const;

 private:
  std::vector<Real> x_, y_, z_, radius_;
};

template <class Visit>
void SphereSet::for_each_near(const Ray& ray, Real end, Real reach, Visit&& visit) const {
  constexpr size_t at_once = 64;
  std::array<Real, at_once> nearest, squares, beyond;
  const Vec3 o = ray.origin, d = ray.direction;
  for (size_t first = 0; first < radius_.size(); first += at_once) {
    const size_t count = std::min(at_once, radius_.size() - first);
    for (size_t i = 0; i < count; ++i) {
      const Real x = x_[first + i] - o.x, y = y_[first + i] - o.y, z = z_[first + i] - o.z;
      const Real t = std::min(std::max(x * d.x + y * d.y + z * d.z, 0.0_r), end);
      nearest[i] = t;
      const Real beside_x = x - d.x * t, beside_y = y - d.y * t, beside_z = z - d.z * t;
      squares[i] = beside_x * beside_x + beside_y * beside_y + beside_z * beside_z;
      const Real most = reach + radius_[first + i];
      beyond[i] = squares[i] - most * most;
    }
    for (size_t i = 0; i < count; ++i)
      if (beyond[i] < 0) visit(static_cast<uint32_t>(first + i), nearest[i], squares[i]);
  }
}

}  // namespace luxodus
