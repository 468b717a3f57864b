// The people whom a command follows or shows: those of the scene, or of a named file. Reads files;
// one thread.
#pragma once

#include <string>
#include <vector>

#include "actors/apps/cli/options.hpp"
#include "runtime/core/result.hpp"
#include "scenes/formats/trajectories/placed_people.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus::cli {

/// --trajectories: a file instead of that of [[people]]. Requires: `file` outlives it.
Option trajectories_option(std::string& file);

/// People of all groups, and what forms their files have.
struct PeopleAsked {
  std::vector<PlacedPerson> people;
  std::vector<std::string> forms;
};

/// The people of the scene, or those of `trajectories`, if it is given, by the only [[people]] of
/// the scene. Errors: as check_walkable, read_trajectories and place_people; nobody; several
/// [[people]] for one file.
Result<PeopleAsked> people_asked(const SceneDescription& scene, const std::string& scene_file,
                                 const std::string& trajectories);

/// The same people where nobody may walk, and the scene need not be one that can be walked.
/// Errors: as read_trajectories and place_people; several [[people]] for one file.
Result<PeopleAsked> people_shown(const SceneDescription& scene, const std::string& scene_file,
                                 const std::string& trajectories);

}  // namespace luxodus::cli
