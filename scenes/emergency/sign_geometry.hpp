// How a sign stands to an eye: distances and angles. It says nothing about smoke or about what
// stands in the way; how bright a sign is: sign_light.hpp. Pure functions; any thread.
// Design: README.md of this folder.
#pragma once

#include <glm/glm.hpp>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// A sign seen from an eye, in clear air.
struct SignView {
  bool behind = false;     // no face is turned to the eye; the numbers below then say where it is
  bool back_face = false;  // it is the second face of a double-sided sign that is seen
  glm::dvec3 centre{0};    // of the face that is seen (the front one if none is) [m]
  glm::dvec3 normal{0, 0, 1};  // out of that face
  double distance_m = 0;       // eye to centre
  double angle_deg = 0;        // between the face's normal and the direction to the eye, 0..180
  double width_arcmin = 0;     // the face's middle line as the eye sees it, foreshortened
  double height_arcmin = 0;
  double detail_arcmin = 0;  // the smallest detail, foreshortened as the worst-lying one is
};

/// Requires: an eye that is not in the centre of a face. A face seen from behind or edge-on has
/// angular sizes of 0.
SignView view_of_sign(const Sign& sign, const glm::dvec3& eye);

/// EN 1838, 5.5 (2013): l = z h. `z` is 200 for signs lit from within and 100 for others; for
/// photoluminescent ones the standard has no factor of its own, so they take the shorter distance.
/// Oblique: z cos(theta) (ISO 3864-1). Information beside a traced result, not a verdict: the rule
/// knows neither smoke nor luminance.
struct ViewingDistance {
  double factor = 0;     // z
  double allowed_m = 0;  // along the normal
  double allowed_oblique_m = 0;
  bool within = false;  // the view's distance is at most the oblique one, and a face is seen
};
ViewingDistance viewing_distance(const Sign& sign, const SignView& view);

/// A sign and an eye on the plan at the height of the eye, where the line-of-sight method works.
struct PlanLine {
  glm::dvec3 to{0};       // where the line from the eye ends: before the face, level with the eye
  double distance_m = 0;  // of its end from the eye
  /// Of the angle of view, from above; 1 of a face that lies level, 0 of one seen from behind.
  double cosine = 0;
};
PlanLine plan_line(const SignView& view, const glm::dvec3& eye);

}  // namespace luxodus
