// Distances and angles between a sign and an eye. Smoke and occlusion are not considered; the
// luminance of a sign is in sign_light.hpp. Pure functions; any thread. Design: README.md of this
// folder.
#pragma once

#include <glm/glm.hpp>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// A sign seen from an eye, in clear air.
struct SignView {
  bool behind =
      false;  // no face is turned to the eye; the other values then describe the front face
  bool back_face = false;      // the visible face is the second one of a double-sided sign
  glm::dvec3 centre{0};        // of the visible face, or of the front face if none is visible [m]
  glm::dvec3 normal{0, 0, 1};  // of that face, outwards
  double distance_m = 0;       // eye to centre
  double angle_deg = 0;        // between the face's normal and the direction to the eye, 0..180
  double width_arcmin = 0;     // of the face's middle line, foreshortened
  double height_arcmin = 0;
  double detail_arcmin = 0;  // the smallest detail in its most foreshortened orientation
};

/// Requires: the eye is not in the centre of a face. Angular sizes of a face seen from behind or
/// edge-on are 0.
SignView view_of_sign(const Sign& sign, const glm::dvec3& eye);

/// Viewing distance l = z h (EN 1838:2013, 5.5). `z` is 200 for signs lit from within and 100 for
/// others; the standard has no factor for photoluminescent signs, so they get the shorter distance.
/// Oblique: z cos(theta) (ISO 3864-1). It is printed beside a traced result and decides nothing,
/// since the rule knows neither smoke nor luminance.
struct ViewingDistance {
  double factor = 0;     // z
  double allowed_m = 0;  // along the face's normal
  double allowed_oblique_m = 0;
  bool within = false;  // the distance is at most the oblique one, and a face is seen
};
ViewingDistance viewing_distance(const Sign& sign, const SignView& view);

/// A sign and an eye in plan, at the height of the eye: the geometry of the line-of-sight method.
struct PlanLine {
  glm::dvec3 to{0};  // end of the line from the eye: just before the face, at the height of the eye
  double distance_m = 0;  // from the eye to that end
  /// Cosine of the angle of view in plan; 1 for a horizontal face, 0 for a face seen from behind.
  double cosine = 0;
};
PlanLine plan_line(const SignView& view, const glm::dvec3& eye);

}  // namespace luxodus
