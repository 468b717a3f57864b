// Whether people of trajectory files walk where the building is: a wrong unit, origin or turn sends
// them through walls. Doors do not count: people open them. Thread rule: one thread, which has rays
// computed by others.
#pragma once

#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "scenes/formats/trajectories/placed_people.hpp"

namespace luxodus {

namespace limits {
/// Share of steps through walls and in solids beyond which people are not where they walked.
inline constexpr double steps_in_walls = 0.01;
/// Steps that are checked; of more, evenly chosen ones.
inline constexpr size_t wall_steps = 200'000;
}  // namespace limits

/// Steps of half a second, of all people together.
struct WallCheck {
  size_t steps = 0, wrong = 0;  // wrong: across a wall, or beginning in a solid
  double share() const {
    return steps == 0 ? 0 : static_cast<double>(wrong) / static_cast<double>(steps);
  }
};

/// Errors: a pack, which does not hold all that people walk in; people who stand as bodies, since
/// they would look through their own heads.
Result<void> check_walkable(const SceneDescription& scene);

/// The building of only what nobody walks through: without doors, what is not there, and
/// measurements. Errors: as compile_scene.
Result<std::unique_ptr<Building>> walls_alone(const SceneDescription& scene,
                                              const Scenario& scenario, int threads);

/// Looks along all steps a metre above the floor, above low furniture. Errors: a person outside of
/// the building, or a larger share than limits::steps_in_walls, with the first place; as
/// compile_scene; a scene without surfaces.
Result<WallCheck> check_walls(const SceneDescription& scene, const Scenario& scenario,
                              const std::vector<PlacedPerson>& people, int threads);

}  // namespace luxodus
