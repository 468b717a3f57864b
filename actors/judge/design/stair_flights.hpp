// Flights of stairs: those that objects are made of, and those that routes climb. Pure functions;
// any thread.
#pragma once

#include <vector>

#include "scenes/light/world/design.hpp"

namespace luxodus {

/// Each flight once: that of an object where a route climbs one, too.
std::vector<StairFlight> stair_flights_of(const SceneDescription& scene,
                                          const DesignSettings& design);

/// The middle of each tread, from below.
std::vector<glm::dvec3> treads_of(const StairFlight& stairs);

}  // namespace luxodus
