// Rays to what stands around a place where something may be mounted, and how places and directions
// are told. Thread rule: as Building::each gives access.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

/// From a place to the first body that light does not pass, along a direction of unit length [m];
/// none within a length. Faces of signs and luminaires stop nothing.
std::optional<double> wall_distance(const Building& building, const GeometryAccess& access,
                                    const glm::dvec3& from, const glm::dvec3& direction,
                                    double length_m);

/// A place to the millimetre, and a direction to 1e-6, as files have them. Without negative zeros,
/// which nobody wants to read.
glm::dvec3 told_place(const glm::dvec3& place);
glm::dvec3 told_direction(const glm::dvec3& direction);

}  // namespace luxodus
