// Luminance that a sign emits: of each of its colours, and the decay of photoluminescent material.
// Not here: light reflected by the face, and smoke in front of it. Pure functions; any thread.
// Design: README.md of this folder.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Share of the luminance left `seconds` after excitation. Between points it is linear in log time
/// and log share, as phosphorescence follows powers of time. Before the first point the first share
/// holds; after the last, the power of the last two points continues, never rising. A segment that
/// starts at time 0 or has a share of 0 is linear instead. Empty: 1.
/// Requires: times ascending and >= 0, shares >= 0.
double decay_share(const std::vector<glm::dvec2>& decay, double seconds);

/// Luminance [cd/m2] that the sign itself emits in one colour of its face, in a direction whose
/// cosine with the face's normal is given: L cos^n. In operation `dark` only photoluminescent signs
/// emit; externally lit signs emit nothing (their light is reflected), nor does `other`. The caller
/// applies a circuit's factor and a face's luminance map.
double sign_luminance(const Sign& sign, ColourIndex colour, Operation operation,
                      double seconds_after_failure, double cos_from_normal);

}  // namespace luxodus
