// Distances to walls around a mounting place, and rounding of places and directions for files.
// Thread rule: as Building::each gives access.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

/// Distance from a place to the first opaque body along a unit vector [m]; none within `length_m`.
/// Faces of signs and luminaires are ignored.
std::optional<double> wall_distance(const Building& building, const GeometryAccess& access,
                                    const glm::dvec3& from, const glm::dvec3& direction,
                                    double length_m);

/// A place rounded to a millimetre, and a direction rounded to 1e-6, as files have them; -0 becomes
/// 0.
glm::dvec3 told_place(const glm::dvec3& place);
glm::dvec3 told_direction(const glm::dvec3& direction);

}  // namespace luxodus
