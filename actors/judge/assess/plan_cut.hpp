// Floors of a building for plans: heights on which its routes and areas lie, and horizontal
// sections of its surfaces at breast height above each. It draws nothing. Pure functions; any
// thread.
#pragma once

#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Lines of a plan; beyond this the shortest are left out.
inline constexpr size_t plan_lines = 20'000;
/// Floors that are drawn, from below.
inline constexpr size_t plan_levels = 100;
/// Grid points of an illuminance map: 1250 m2 at a spacing of 0.25 m.
inline constexpr size_t map_places = 20'000;
}  // namespace limits

/// Heights of the floors on which routes or areas lie, from below; one less than two metres above
/// another counts as its landing. Empty without routes and areas.
std::vector<double> floors_of(const SceneDescription& scene);

/// One level with its walls for each floor on which routes or areas lie, from below
/// (floors_of). Without routes and areas one level at zero.
std::vector<PlanLevel> plan_levels(const SceneDescription& scene, const Scenario& doors);

/// Index of the level of a place: the highest whose floor is at most half a metre above the place,
/// else the lowest. Requires: at least one level.
size_t level_of(const std::vector<PlanLevel>& levels, double z);

/// The longest lines, at most limits::plan_lines.
std::vector<std::pair<glm::dvec2, glm::dvec2>> longest_lines(
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines);

/// Grid of a level's illuminance map without values, around its routes and areas and within its
/// walls. The spacing is 0.25 m, doubled until the grid keeps the limit.
LightMap map_of(const SceneDescription& scene, const std::vector<PlanLevel>& levels, size_t level);

/// The same over an area alone.
LightMap map_over(const AssessedArea& area);

}  // namespace luxodus
