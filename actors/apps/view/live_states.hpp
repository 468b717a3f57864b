// States of the building as nodes that trace for a live view make them: of edits, as text.
// Any thread.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "actors/results/run/scene_state.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

/// What the nodes of a process share: the last state that any of them was asked for.
class LiveStates final : public StateMaker {
 public:
  /// `read`: the scene at other times, where it has a clock; may be empty.
  explicit LiveStates(std::shared_ptr<const SceneDescription> scene, SceneAtTime read = {})
      : scenes_(std::move(scene), std::move(read)) {}
  /// Compiles it, unless it is the last. Errors: as parse_edits, TimedScenes::at and
  /// compile_live.
  Result<std::shared_ptr<const TracedState>> make(const std::string& edits) override;

 private:
  TimedScenes scenes_;
  std::mutex mutex_;
  std::string edits_;
  std::shared_ptr<const TracedState> state_;
};

}  // namespace luxodus
