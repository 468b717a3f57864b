// How a sign stands to an eye, and how bright it is of itself: distances, angles, the decay of
// photoluminescent material, and the light a face sends out. It says nothing about smoke, about
// what stands in the way, or about light falling on the face. Pure functions; any thread.
// Design: README.md of this folder.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/world/description.hpp"

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

/// Share of the luminance left `seconds` after excitation: linear in log time and log share between
/// points, as phosphorescence follows powers of time; the first share before the first point; on
/// along the last two points after the last, never rising. A segment that starts at time 0 or has
/// a share of 0 is linear instead. Empty: 1.
/// Requires: times ascending and >= 0, shares >= 0.
double decay_share(const std::vector<glm::dvec2>& decay, double seconds);

/// Luminance [cd/m2] of one colour of the face, as sent out by the sign itself in a direction
/// whose cosine with the face's normal is given: L cos^n. `dark` leaves photoluminescent signs
/// alone; externally lit signs send out nothing of their own (their light is reflected), and
/// `other` never does. A circuit's factor and a face's luminance map are the caller's to apply.
double sign_luminance(const Sign& sign, SignColour colour, Operation operation,
                      double seconds_after_failure, double cos_from_normal);

}  // namespace luxodus
