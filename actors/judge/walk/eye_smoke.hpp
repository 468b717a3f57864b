// The smoke at an eye, at times between the states of a scene. Pure functions; any thread.
#pragma once

#include <vector>

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

/// Extinction of the media of a building at an eye, at the wavelength of stated extinctions [1/m].
double extinction_at_eye(const Building& building, const GeometryAccess& access,
                         const glm::dvec3& eye);

/// Weight of a state at a time, for values that are linear between two states: 1 at the state's own
/// time, falling to 0 at its neighbours'. Requires: ascending times, at least one.
double weight_of_state(const std::vector<double>& times_s, size_t state, double time_s);

}  // namespace luxodus
