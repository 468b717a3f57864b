// Reads the `[[people]]` of a scene file. They are no part of its description, since light knows
// nothing of them unless they stand as bodies: without, a scene with other people is the same
// scene, with the same hash. Their mistakes
// are reported by read_scene as well. Any thread, one call per scene.
#pragma once

#include <filesystem>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/world/people.hpp"

namespace luxodus {

struct ReadPeople {
  std::vector<PeopleSettings> people;  // in the order of the files
  Problems problems;
};

/// The people of this file and of those it includes. Their trajectories are not read.
ReadPeople read_people_of_scene(const std::filesystem::path& path);

}  // namespace luxodus
