// Equiangular sampling: draws points on a line with density proportional to 1 / (squared distance
// from a given point) (C. Kulla, M. Fajardo, "Importance sampling techniques for path tracing in
// participating media", EGSR 2012). Estimates of light from that point then stay bounded, however
// near to it the line passes. Computed in double, so that angles keep their precision on long
// lines. Immutable; any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace luxodus {

class EquiangularLine {
 public:
  /// The first `length` [m] of the ray (`direction` is unit), as seen from `point`. Requires: a
  /// finite length above 0.
  EquiangularLine(const glm::dvec3& origin, const glm::dvec3& direction, double length,
                  const glm::dvec3& point)
      : length_(length), foot_(glm::dot(point - origin, direction)) {
    // The distance is kept above 0, since from a point on the line all of it lies at one angle.
    height_ = std::max(glm::distance(point, origin + foot_ * direction), 1e-7 * length);
    low_ = std::atan2(-foot_, height_);
    angle_ = std::atan2(length - foot_, height_) - low_;
  }

  /// A distance from the origin [m]; u in [0, 1).
  double sample(double u) const {
    const double t = foot_ + height_ * std::tan(low_ + u * angle_);
    return std::clamp(t, 0.0, length_);
  }

  /// Density of that distance [1/m]; 0 beyond the line.
  double density(double t) const {
    if (!(t >= 0 && t <= length_)) return 0;
    const double from_foot = t - foot_;
    return height_ / (angle_ * (height_ * height_ + from_foot * from_foot));
  }

 private:
  double length_;
  double foot_;    // foot of the perpendicular, along the ray
  double height_;  // distance of the point from the line
  double low_;     // angle of the line's start from the perpendicular
  double angle_;   // angle that the whole line subtends
};

}  // namespace luxodus
