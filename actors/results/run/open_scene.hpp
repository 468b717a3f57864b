// The scene that somebody asks for: a scene file or a pack, its scenarios, its states at other
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
  std::shared_ptr<const SceneDescription> scene;  // null where there are problems
  Problems problems;
};

/// `at_s`: time of its fire simulations instead of the one that it states. `changes`: as TOML; see
/// read_scene. A pack has one time and is not changed. `frames`: what simulations have between two.
/// `share`: hears how far reading is; packs are mapped, not read.
OpenedScene open_scene(const std::filesystem::path& file, std::optional<double> at_s = std::nullopt,
                       const std::string& changes = {}, FireFrames frames = FireFrames::between,
                       ReadingShare* share = nullptr);

/// Reads a scene again that was read from this file, by the same path, with these changes.
/// Errors: the first of its problems; files that are others than when `scene` was read.
Result<std::shared_ptr<const SceneDescription>> reopen_scene(const SceneDescription& scene,
                                                             const std::filesystem::path& file,
                                                             std::optional<double> at_s,
                                                             FireFrames frames,
                                                             const std::string& changes = {});

/// Reads it at other times, as reopen_scene does.
SceneAtTime reader_at_times(const SceneDescription& scene, const std::filesystem::path& file,
                            FireFrames frames, const std::string& changes = {});

/// A scene with fire simulations as verdicts are of it: at their frames, not between two. The last
/// few states are kept. The file is read at the first verdict. Any thread.
class FrameScenes {
 public:
  /// Of the scene that `file` is at `at_s`, as open_scene takes them. Null where it has no
  /// simulation, and of a pack, which is as it was packed: verdicts are then of the scene itself.
  static std::shared_ptr<FrameScenes> of(const SceneDescription& scene,
                                         const std::filesystem::path& file,
                                         std::optional<double> at_s);

  /// As the scene stands where no time is said. Errors: the first of its problems; files that are
  /// others than when the scene was read.
  Result<std::shared_ptr<const SceneDescription>> at(std::optional<double> at_s);

 private:
  FrameScenes(std::shared_ptr<const FilesAsRead> files, std::filesystem::path file,
              std::optional<double> at_s)
      : files_(std::move(files)), file_(std::move(file)), at_s_(at_s) {}

  const std::shared_ptr<const FilesAsRead> files_;
  const std::filesystem::path file_;
  const std::optional<double> at_s_;
  std::mutex mutex_;
  std::optional<TimedScenes> scenes_;  // read when a verdict is asked for
};

/// The scenarios that a name stands for: one, all of them for "all", the first for "".
/// Errors: as find_scenario.
Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name);

}  // namespace luxodus
