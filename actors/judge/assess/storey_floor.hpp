// The floor of the storey to which a thing belongs: the one below it, as rays find it. Thread rule:
// called from one thread, which has rays computed by others.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

/// Height of the first surface below a thing that is not furniture; none if there is none. What is
/// nearer than 0.15 m and is met from inside or behind is the thing's own body or the ceiling that
/// it is recessed in.
std::optional<double> surface_below(const Building& building, const GeometryAccess& access,
                                    const glm::dvec3& thing);

/// For each thing, the height of the floor of its storey: of the surface below it, where a route or
/// an area lies at about that height; else of the nearest route or area below it; none without
/// either. So a luminaire under the ceiling of a room belongs to the room, though a landing beside
/// the room is hardly higher.
std::vector<std::optional<double>> storey_floors(const SceneDescription& scene,
                                                 const Building& building,
                                                 std::span<const glm::dvec3> things);

/// The same for a point of emphasis, which may lie in a wall, a door or a step. `around`: places
/// beside it.
std::optional<double> storey_floor_around(const SceneDescription& scene, const Building& building,
                                          const glm::dvec3& point,
                                          std::span<const glm::dvec3> around);

}  // namespace luxodus
