// Intensity of emitters from afar, by direction. Pure functions; any thread.
#pragma once

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// The middle of an emitter's luminous opening [m].
glm::dvec3 centre_of(const Emitter& e);

/// Intensity [cd] per lumen in a direction [scene coordinates]; of a mesh as if none of its parts
/// hid another. Requires: neither a spot nor a collimated emitter.
double intensity_per_lm(const Emitter& e, const glm::dvec3& world);

/// Intensity [cd] per lumen of a spot at an angle from its axis: full within the inner angle, zero
/// outside the outer one, between them the smooth step in 1 - cos that the tracer samples.
double spot_per_lm(const Emitter& e, double off_axis_deg);

}  // namespace luxodus
