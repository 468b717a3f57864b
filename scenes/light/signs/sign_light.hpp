// How bright a sign is of itself: the luminance of its colours and the decay of photoluminescent
// material. It says nothing about light that falls on the face or
// about smoke before it. Pure functions; any thread. Design: README.md of this folder.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

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
