// A body bounded by a quadric surface and clipped by half spaces and its bounding box: ray
// intervals, containment, volume, and uniform points in it. It need not be convex: a ray may have
// two segments in a hyperboloid. Immutable once made; any thread.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/medium.hpp"
#include "scenes/light/optics/ray_interval.hpp"

namespace luxodus {

namespace limits {
inline constexpr int max_clip_planes = 64;
/// Least share of its box that a body must fill, to limit the rejections per uniform point.
inline constexpr double min_body_fill = 1e-4;
/// Draws for one uniform point in a body; the chance to need more is below exp(-26) at the least
/// fill.
inline constexpr int max_body_draws = 1 << 18;
}  // namespace limits

class QuadricBody {
 public:
  /// Errors: bounds missing, numbers not finite, frame not orthonormal, nothing inside the bounds.
  static Result<QuadricBody> make(const Medium& medium, const glm::dvec3& local_origin);

  /// The segments of a ray inside the body, within `within`: at most two, ascending.
  int intervals(const glm::dvec3& o, const glm::dvec3& d, RayInterval within,
                RayInterval out[2]) const {
    return local_intervals(to_local(o), d * axes_, within, out);
  }
  bool contains(const glm::dvec3& p) const { return contains_local(to_local(p)); }

  struct Volume {
    double m3 = 0;
    double error_m3 = 0;  // 0: closed form
  };
  /// Closed form if the cross-sections perpendicular to some local axis are whole ellipses between
  /// planes perpendicular to it (ellipsoid, cylinder, cone, paraboloid, hyperboloid so cut); else a
  /// quadrature by rays whose error is estimated from two resolutions.
  const Volume& volume() const { return volume_; }

  /// A point uniform in the body. `next_uniform()` gives independent numbers in [0, 1).
  template <class Uniform>
  glm::dvec3 sample(Uniform&& next_uniform) const;

  /// A box in the tracer's coordinates that holds the body.
  Bounds bounds() const;

 private:
  glm::dvec3 to_local(const glm::dvec3& p) const { return (p - origin_) * axes_; }
  int local_intervals(const glm::dvec3& o, const glm::dvec3& d, RayInterval within,
                      RayInterval out[2]) const;
  bool contains_local(const glm::dvec3& p) const;
  bool closed_form_volume(int axis);
  void measure_volume();
  double volume_by_rays(int n);

  glm::dvec3 origin_{0};
  glm::dmat3 axes_{1.0};  // columns: local axes in the tracer's coordinates
  glm::dmat3 a_{0.0};     // symmetric
  glm::dvec3 b_{0};
  double c_ = 0;
  std::vector<Quadric::Clip> clips_;
  glm::dvec3 low_{0};
  glm::dvec3 high_{0};
  glm::dvec3 inner_point_{0};  // local; returned if no draw succeeds
  Volume volume_;
};

template <class Uniform>
glm::dvec3 QuadricBody::sample(Uniform&& next_uniform) const {
  const glm::dvec3 size = high_ - low_;
  for (int i = 0; i < limits::max_body_draws; ++i) {
    const double u = next_uniform();
    const double v = next_uniform();
    const double w = next_uniform();
    const glm::dvec3 p = low_ + size * glm::dvec3(u, v, w);
    if (contains_local(p)) return origin_ + axes_ * p;
  }
  return origin_ + axes_ * inner_point_;
}

/// Parameters s with a s^2 + b s + c <= 0, as at most two ascending intervals of the real line.
int below_zero(double a, double b, double c, RayInterval out[2]);

/// Whether a frame has orthonormal axes and everything is finite; what is wrong goes on from a
/// name.
Result<void> check_frame(const Frame& frame);

}  // namespace luxodus
