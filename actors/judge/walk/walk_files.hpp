// The files of followed people: tables of people, signs, steps and of the share of people over
// time, a curve and maps as SVG, and all of it but the steps as JSON. Pure but for writing; any
// thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "actors/judge/record/plan_record.hpp"
#include "actors/judge/walk/walk_scene.hpp"
#include "actors/judge/walk/walk_summary.hpp"

namespace luxodus {

/// What the files say of a walk.
struct WalkToWrite {
  const SceneDescription& scene;
  const std::vector<PlacedPerson>& people;
  const WalkOptions& options;
  const WalkOfScene& walk;
  std::vector<PlanLevel> levels;   // with their walls, from below; at least one
  std::vector<std::string> forms;  // of the files of trajectories, by group
  std::string version;             // of this program
};

/// Files that write_walk writes, besides those of the levels.
inline const std::vector<std::string> walk_files{"people.csv", "signs.csv", "steps.csv",
                                                 "curve.csv",  "curve.svg", "walk.json"};
/// "map.svg", or "map_1.svg", ... with several levels, and "animation.svg" likewise. Only those of
/// levels on which people walk are written; somebody who changes the level is in the animation of
/// that of their first step.
std::vector<std::string> level_files(const std::string& what, size_t levels);

FollowedPeople record_of(const WalkToWrite& walk);

/// Errors: as write_file_atomically.
Result<void> write_walk(const std::filesystem::path& folder, const WalkToWrite& walk,
                        const FollowedPeople& followed);

/// People who walk over the walls of a level, coloured by whether they read a sign, four times as
/// fast as they walk: an SVG that plays in a browser. Requires: at least one person.
std::string walk_animation(const PlanLevel& level, const std::vector<const WalkedPerson*>& walks,
                           double step_s);

}  // namespace luxodus
