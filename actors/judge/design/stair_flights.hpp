// Flights of stairs: those of objects, and those that routes climb. Pure functions; any thread.
#pragma once

#include <vector>

#include "scenes/light/world/design.hpp"

namespace luxodus {

/// Each flight once; if a route climbs the stairs of an object, the flight is that of the object.
std::vector<StairFlight> stair_flights_of(const SceneDescription& scene,
                                          const DesignSettings& design);

/// Centre of each tread, from below.
std::vector<glm::dvec3> treads_of(const StairFlight& stairs);

}  // namespace luxodus
