// Opens the scene that the user names: a scene file or a pack, its scenarios, its states at other
// times. Reads files; any thread.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/world/fire_frames.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

class ReadingShare;

struct OpenedScene {
  std::shared_ptr<const SceneDescription> scene;  // null if there are problems
  Problems problems;
};

/// `at_s`: time for its fire simulations, replacing the stated one. `changes`: TOML, see
/// read_scene. A pack has one time and cannot be changed. `frames`: the state of simulations
/// between two frames. `share`: receives the progress of reading; packs are mapped, not read.
OpenedScene open_scene(const std::filesystem::path& file, std::optional<double> at_s = std::nullopt,
                       const std::string& changes = {}, FireFrames frames = FireFrames::between,
                       ReadingShare* share = nullptr);

/// Reads a scene again from its file, by the same path, with these changes.
/// Errors: the first of its problems; files that have changed since `scene` was read.
Result<std::shared_ptr<const SceneDescription>> reopen_scene(const SceneDescription& scene,
                                                             const std::filesystem::path& file,
                                                             std::optional<double> at_s,
                                                             FireFrames frames,
                                                             const std::string& changes = {});

/// Reads it at other times, like reopen_scene.
SceneAtTime reader_at_times(const SceneDescription& scene, const std::filesystem::path& file,
                            FireFrames frames, const std::string& changes = {});

/// The scene for verdicts: with fire simulations at their frames, not between two. It caches the
/// last few states. The file is read at the first verdict. Any thread.
class FrameScenes {
 public:
  /// For the scene that `file` has at `at_s`, with the parameters of open_scene. Null if it has no
  /// simulation, or is a pack, whose state is fixed: verdicts then use the scene itself.
  static std::shared_ptr<FrameScenes> of(const SceneDescription& scene,
                                         const std::filesystem::path& file,
                                         std::optional<double> at_s);

  /// The scene at a time, or as it stands without one. Errors: the first of its problems; files
  /// that have changed since the scene was read.
  Result<std::shared_ptr<const SceneDescription>> at(std::optional<double> at_s);

 private:
  FrameScenes(std::shared_ptr<const FilesAsRead> files, std::filesystem::path file,
              std::optional<double> at_s)
      : files_(std::move(files)), file_(std::move(file)), at_s_(at_s) {}

  const std::shared_ptr<const FilesAsRead> files_;
  const std::filesystem::path file_;
  const std::optional<double> at_s_;
  std::mutex mutex_;
  std::optional<TimedScenes> scenes_;  // read at the first verdict
};

/// The scenarios that a name selects: one, all of them for "all", the first for "".
/// Errors: as find_scenario.
Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name);

}  // namespace luxodus
