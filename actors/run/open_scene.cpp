#include "actors/run/open_scene.hpp"

#include <algorithm>

#include "scenes/pack/scene_pack.hpp"
#include "scenes/scene_file/scene_file.hpp"
#include "scenes/transport/compile.hpp"

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

SceneAtTime reader_at_times(const std::filesystem::path& file, FireFrames frames,
                            const std::string& changes) {
  return [file, frames, changes](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    OpenedScene opened = open_scene(file, at_s, changes, frames);
    if (!opened.scene) return opened.problems.list().front();
    return std::move(opened.scene);
  };
}

std::shared_ptr<FrameScenes> FrameScenes::of(const SceneDescription& scene,
                                             const std::filesystem::path& file,
                                             std::optional<double> at_s) {
  const bool has_simulation = std::any_of(scene.media.begin(), scene.media.end(),
                                          [](const Medium& m) { return m.simulation; });
  if (scene.packed || !has_simulation) return nullptr;
  return std::shared_ptr<FrameScenes>(new FrameScenes(file, at_s));
}

Result<std::shared_ptr<const SceneDescription>> FrameScenes::at(std::optional<double> at_s) {
  const std::lock_guard lock(mutex_);
  if (!scenes_) {
    OpenedScene first = open_scene(file_, at_s_, {}, FireFrames::nearest);
    if (!first.scene) return first.problems.list().front();
    scenes_.emplace(std::move(first.scene), reader_at_times(file_, FireFrames::nearest));
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
