// Placing things in a scene: affine maps, frames, units of length, and the upward axis. The scene
// is right-handed, in metres, with z up. Plain values and pure functions; any thread.
#pragma once

#include <cmath>
#include <string_view>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/frame.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

inline bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// p -> linear * p + offset.
struct Transform {
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0};

  glm::dvec3 point(const glm::dvec3& p) const { return linear * p + offset; }
  glm::dvec3 vector(const glm::dvec3& v) const { return linear * v; }
  bool mirrors() const { return glm::determinant(linear) < 0; }
  /// Whether it is finite and keeps volumes non-zero; readers refuse others.
  bool usable() const;
};

/// `second * first` applies `first`, then `second`.
Transform operator*(const Transform& second, const Transform& first);

Transform scaling(const glm::dvec3& factors);
Transform translation(const glm::dvec3& offset);

/// Right-handed rotation about an axis through the origin. Multiples of 90 degrees about a
/// coordinate axis are exact, so that walls that met before a rotation meet after it. Errors: an
/// axis of no length, or a number that is not finite.
Result<Transform> rotation(const glm::dvec3& axis, double degrees);

/// Transforms a mesh. A mirroring map also reverses the winding, so that fronts stay fronts.
/// Requires: transform.usable().
void apply(const Transform& transform, Mesh& mesh);

// ---- units and axes ----------------------------------------------------------------------------

/// Metres in one "m", "mm", "cm", "km", "in" or "ft" (international inch and foot, exact).
/// Errors: any other word.
Result<double> metres_per_unit(std::string_view unit);

enum class UpAxis { y, z };

/// The rotation that makes `up` the scene's z: for y, (x, y, z) -> (x, -z, y).
Transform to_z_up(UpAxis up);

/// Errors: any word but "y" and "z".
Result<UpAxis> up_axis_named(std::string_view word);

// ---- frames ------------------------------------------------------------------------------------

/// Local z along `direction` (a sign's viewing direction), local y as near to `up` as possible,
/// local x to the right of an observer who looks along -z. If `direction` is parallel to `up`,
/// local y is as near as possible to the scene's +y. Errors: a direction or up of no length, or a
/// number that is not finite.
Result<Frame> frame_facing(const glm::dvec3& origin, const glm::dvec3& direction,
                           const glm::dvec3& up = {0, 0, 1});

/// Local -z along `direction` (in which a luminaire emits or a camera looks); otherwise as
/// frame_facing.
Result<Frame> frame_aiming(const glm::dvec3& origin, const glm::dvec3& direction,
                           const glm::dvec3& up = {0, 0, 1});

/// Local -z from `eye` to `target`. Errors: also if the two coincide.
Result<Frame> look_at(const glm::dvec3& eye, const glm::dvec3& target,
                      const glm::dvec3& up = {0, 0, 1});

/// The frame as a map from local to scene coordinates.
Transform as_transform(const Frame& frame);

}  // namespace luxodus
