#include "actors/results/run/open_scene.hpp"

#include <algorithm>

#include "scenes/formats/pack/scene_pack.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/world/files_as_read.hpp"

namespace luxodus {

namespace {

OpenedScene open_pack(const std::filesystem::path& file, bool other_time, bool changed) {
  OpenedScene out;
  if (other_time)
    out.problems.add(problem_in(file, "a pack is of one time: pack the scene again with --at"));
  if (changed)
    out.problems.add(
        problem_in(file, "a pack is not changed: change the scene file that it was made of"));
  if (!out.problems.empty()) return out;
  auto packed = read_pack(file);
  if (packed)
    out.scene = std::move(packed).value();
  else
    out.problems.add(packed.problem());
  return out;
}

using ReadState = Result<std::shared_ptr<const SceneDescription>>;

/// The scene at a time, from unchanged files: `files`, null if they are not known.
ReadState opened_as(const FilesAsRead* files, const std::filesystem::path& file,
                    std::optional<double> at_s, const std::string& changes, FireFrames frames) {
  OpenedScene opened = open_scene(file, at_s, changes, frames);
  if (!opened.scene) {
    // If a file was edited, that is reported before the file's own problems.
    if (files != nullptr)
      if (auto ok = files->unchanged_on_disk(); !ok) return ok.problem();
    return opened.problems.list().front();
  }
  if (files != nullptr && opened.scene->files)
    if (auto ok = files->unchanged_in(*opened.scene->files); !ok) return ok.problem();
  return std::move(opened.scene);
}

}  // namespace

OpenedScene open_scene(const std::filesystem::path& file, std::optional<double> at_s,
                       const std::string& changes, FireFrames frames, ReadingShare* share) {
  if (is_pack(file)) return open_pack(file, at_s.has_value(), !changes.empty());
  ReadScene read = read_scene(file, at_s, changes, frames, share);
  OpenedScene out;
  out.problems = std::move(read.problems);
  if (read.scene) out.scene = std::make_shared<const SceneDescription>(std::move(*read.scene));
  return out;
}

ReadState reopen_scene(const SceneDescription& scene, const std::filesystem::path& file,
                       std::optional<double> at_s, FireFrames frames, const std::string& changes) {
  return opened_as(scene.files.get(), file, at_s, changes, frames);
}

SceneAtTime reader_at_times(const SceneDescription& scene, const std::filesystem::path& file,
                            FireFrames frames, const std::string& changes) {
  return [files = scene.files, file, frames, changes](double at_s) {
    return opened_as(files.get(), file, at_s, changes, frames);
  };
}

std::shared_ptr<FrameScenes> FrameScenes::of(const SceneDescription& scene,
                                             const std::filesystem::path& file,
                                             std::optional<double> at_s) {
  const bool has_simulation = std::any_of(scene.media.begin(), scene.media.end(),
                                          [](const Medium& m) { return m.simulation; });
  if (scene.packed || !has_simulation) return nullptr;
  return std::shared_ptr<FrameScenes>(new FrameScenes(scene.files, file, at_s));
}

Result<std::shared_ptr<const SceneDescription>> FrameScenes::at(std::optional<double> at_s) {
  const std::lock_guard lock(mutex_);
  if (!scenes_) {
    auto first = opened_as(files_.get(), file_, at_s_, {}, FireFrames::nearest);
    if (!first) return first.problem();
    const SceneAtTime others = reader_at_times(*first.value(), file_, FireFrames::nearest);
    scenes_.emplace(std::move(first).value(), others);
  }
  return scenes_->at(at_s);
}

Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name) {
  if (name == "all" && !scene.scenarios.empty()) return scene.scenarios;
  auto one = find_scenario(scene, name == "all" ? "" : name);
  if (!one) return one.problem();
  return std::vector<Scenario>{one.value()};
}

}  // namespace luxodus
