// The floors of a building for plans: where its routes and areas lie, and its surfaces as a level
// plane cuts them at breast height above each. Pure; any thread.
#pragma once

#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Lines of a plan; more are left out, the shortest first.
inline constexpr size_t plan_lines = 20'000;
/// Floors that are drawn, from below; a building of more has other needs.
inline constexpr size_t plan_levels = 100;
/// Places of a map of light: twice as many square metres at 0.25 m would be 300 m2.
inline constexpr size_t map_places = 20'000;
}  // namespace limits

/// One for each floor that routes or areas lie on, from below, with its walls. Floors less than
/// two metres above another are landings of it. One at zero where there are neither.
std::vector<PlanLevel> plan_levels(const SceneDescription& scene, const Scenario& doors);

/// The number of the level that a place belongs to: the highest whose floor is not above it by
/// more than half a metre, else the lowest. Requires: a level.
size_t level_of(const std::vector<PlanLevel>& levels, double z);

/// At most limits::plan_lines of them.
std::vector<std::pair<glm::dvec2, glm::dvec2>> longest_lines(
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines);

/// The grid of a level's map of light, without its values: around its routes and areas, within its
/// walls, 0.25 m apart or, where that is more than a limit, twice as far until it is not.
LightMap map_of(const SceneDescription& scene, const std::vector<PlanLevel>& levels, size_t level);

}  // namespace luxodus
