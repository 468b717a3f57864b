// Places on a line, drawn as a point's light falls on it: in proportion to one over their squared
// distance from the point (C. Kulla, M. Fajardo, "Importance sampling techniques for path tracing
// in participating media", EGSR 2012). What divides by that square is then bounded however near to
// the point the line passes. In double: angles are as fine as the line is long. Pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace luxodus {

class EquiangularLine {
 public:
  /// The first `length` [m] of the ray (`direction` is unit), as seen from `point`. Requires: a
  /// length above 0, finite.
  EquiangularLine(const glm::dvec3& origin, const glm::dvec3& direction, double length,
                  const glm::dvec3& point)
      : length_(length), foot_(glm::dot(point - origin, direction)) {
    // A point on the line itself would see all of it at one angle.
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
  double foot_;    // of the perpendicular, along the ray
  double height_;  // of the point above the line
  double low_;     // the angle at which the line begins, from the perpendicular
  double angle_;   // of all of it
};

}  // namespace luxodus
