// Curves of drawings as chords. Arcs and ellipses are off by at most 0.5 % of their radius. Pure
// functions; any thread.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace luxodus {

/// The axes of an entity's own coordinates (OCS) for its extrusion direction, by Autodesk's
/// "arbitrary axis algorithm". An extrusion of no length is +z.
struct DxfAxes {
  explicit DxfAxes(const glm::dvec3& extrusion);

  glm::dvec3 x, y, z;

  /// A point as seen from above.
  glm::dvec2 plan(const glm::dvec3& p) const { return glm::dvec2(p.x * x + p.y * y + p.z * z); }
};

/// Points centre + cos(t) u + sin(t) v from t = `from` to `to` [rad]; a whole turn where both are
/// equal. Empty where they are not finite.
std::vector<glm::dvec2> elliptic_arc(const glm::dvec2& centre, const glm::dvec2& u,
                                     const glm::dvec2& v, double from, double to);

/// Points after `from` up to `to` of a side with a bulge, the tangent of a quarter of its angle.
std::vector<glm::dvec2> bulged_side(const glm::dvec2& from, const glm::dvec2& to, double bulge);

/// A B-spline curve, rational where there are weights. Empty where the knots do not fit the points:
/// one more than points and degree together, ascending.
std::vector<glm::dvec2> b_spline(int degree, std::span<const double> knots,
                                 std::span<const glm::dvec2> points,
                                 std::span<const double> weights);

}  // namespace luxodus
