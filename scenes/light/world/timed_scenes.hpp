// A scene at several times. The last few are cached, since reading one takes as long as opening the
// scene. Any thread.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "runtime/core/result.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Descriptions that are cached, besides the first: each holds the triangles of the scene.
inline constexpr size_t kept_scenes = 4;
}  // namespace limits

/// Reads the scene at a time [s]. Errors: those of reading it.
using SceneAtTime = std::function<Result<std::shared_ptr<const SceneDescription>>(double at_s)>;

class TimedScenes {
 public:
  /// If `read` is empty, only the first exists.
  TimedScenes(std::shared_ptr<const SceneDescription> first, SceneAtTime read)
      : first_(std::move(first)), read_(std::move(read)) {}

  /// The scene at a time; the first if no time is given. Errors: those of the reader; a time
  /// without a reader.
  Result<std::shared_ptr<const SceneDescription>> at(std::optional<double> at_s);

 private:
  const std::shared_ptr<const SceneDescription> first_;
  const SceneAtTime read_;
  std::mutex mutex_;
  std::deque<std::shared_ptr<const SceneDescription>> kept_;  // most recently used first
};

}  // namespace luxodus
