#include "actors/apps/cli/people_asked.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "actors/apps/cli/progress_line.hpp"
#include "actors/judge/walk/wall_check.hpp"
#include "scenes/formats/scene_file/scene_people.hpp"

namespace luxodus::cli {

namespace {

Result<std::vector<PeopleSettings>> groups_asked(const std::string& scene_file,
                                                 const std::string& trajectories) {
  ReadPeople read = read_people_of_scene(scene_file);
  if (!read.problems.empty()) return read.problems.list().front();
  if (trajectories.empty()) return std::move(read.people);
  if (read.people.size() > 1)
    return problem_in(scene_file,
                      "--trajectories replaces the file of one [[people]], and this scene has "
                      "several");
  PeopleSettings one = read.people.empty() ? PeopleSettings() : std::move(read.people.front());
  if (one.name.empty()) one.name = std::filesystem::path(trajectories).stem().string();
  one.file = trajectories;
  return std::vector<PeopleSettings>{std::move(one)};
}

}  // namespace

Option trajectories_option(std::string& file) {
  return {"--trajectories",
          &file,
          "File of trajectories, instead of that of [[people]] in the scene",
          {.form = Form::file}};
}

Result<PeopleAsked> people_asked(const SceneDescription& scene, const std::string& scene_file,
                                 const std::string& trajectories) {
  if (auto ok = check_walkable(scene); !ok) return ok.problem();
  auto people = people_shown(scene, scene_file, trajectories);
  if (people && people->forms.empty())
    return problem_in(scene_file,
                      "nobody walks in this scene: state [[people]], or name a file by "
                      "--trajectories");
  return people;
}

Result<PeopleAsked> people_shown(const SceneDescription& scene, const std::string& scene_file,
                                 const std::string& trajectories) {
  const auto groups = groups_asked(scene_file, trajectories);
  if (!groups) return groups.problem();
  PeopleAsked out;
  for (const PeopleSettings& group : groups.value()) {
    const WaitingLine waiting("reading " + group.file);
    const auto file = read_trajectories(group.file);
    if (!file) return file.problem();
    auto placed = place_people(group, file.value(), scene.assessment);
    if (!placed) return placed.problem();
    std::move(placed->begin(), placed->end(), std::back_inserter(out.people));
    out.forms.push_back(file->form);
  }
  return out;
}

}  // namespace luxodus::cli
