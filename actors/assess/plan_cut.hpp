// A plan of a building: its surfaces as a level plane cuts them at breast height above the floor of
// its routes. Pure; any thread.
#pragma once

#include <utility>
#include <vector>

#include "scenes/world/description.hpp"

namespace luxodus {

namespace limits {
/// Lines of a plan; more are left out, the shortest first.
inline constexpr size_t plan_lines = 20'000;
}  // namespace limits

std::vector<std::pair<glm::dvec2, glm::dvec2>> walls_of(const SceneDescription& scene);

}  // namespace luxodus
