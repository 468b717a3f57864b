// Legs of routes that climb stairs, as far as the route alone tells. Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Whether a leg is steeper than 15 degrees: ramps have up to 10.
bool climbs_stairs(const glm::dvec3& from, const glm::dvec3& to);

/// Name of a flight of stairs on a route, counted from 1: "way, flight 1".
std::string flight_name(const EscapeRoute& route, size_t number);

/// Places on a leg, one for each tread of usual height: where the stairs themselves are not drawn.
std::vector<glm::dvec3> treads_on_line(const glm::dvec3& from, const glm::dvec3& to);

}  // namespace luxodus
