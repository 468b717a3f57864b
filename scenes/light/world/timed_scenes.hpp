// A scene at several times. The last few are kept: reading one again takes as long as opening the
// scene did. Any thread.
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
/// Descriptions that are kept, besides the first: each holds the triangles of the scene.
inline constexpr size_t kept_scenes = 4;
}  // namespace limits

/// Reads the scene as it is at a time [s]. Errors: as reading it.
using SceneAtTime = std::function<Result<std::shared_ptr<const SceneDescription>>(double at_s)>;

class TimedScenes {
 public:
  /// `read` may be empty: then there is the first alone.
  TimedScenes(std::shared_ptr<const SceneDescription> first, SceneAtTime read)
      : first_(std::move(first)), read_(std::move(read)) {}

  /// The first where no time is said. Errors: as the reader; a time, and none.
  Result<std::shared_ptr<const SceneDescription>> at(std::optional<double> at_s);

 private:
  const std::shared_ptr<const SceneDescription> first_;
  const SceneAtTime read_;
  std::mutex mutex_;
  std::deque<std::shared_ptr<const SceneDescription>> kept_;  // the last asked for first
};

}  // namespace luxodus
