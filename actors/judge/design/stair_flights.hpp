// Flights of stairs that are objects of the scene. Those that routes climb: FlightOfRoute in
// actors/judge/inspect/route_floor.hpp. Pure functions; any thread.
#pragma once

#include <vector>

#include "scenes/light/world/design.hpp"

namespace luxodus {

/// Flights of objects that no route climbs: a flight on a route is that of the route.
std::vector<StairFlight> flights_beside_routes(const SceneDescription& scene,
                                               const DesignSettings& design);

/// Centre of each tread, from below.
std::vector<glm::dvec3> treads_of(const StairFlight& stairs);

}  // namespace luxodus
