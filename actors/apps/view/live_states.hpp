// States of the building on nodes that trace for a live view: made from the text of edits. Any
// thread.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "actors/results/run/scene_state.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

/// Shared by the nodes of a process: caches the last requested state.
class LiveStates final : public StateMaker {
 public:
  /// `read`: the scene at other times, where it has a clock; may be empty.
  explicit LiveStates(std::shared_ptr<const SceneDescription> scene, SceneAtTime read = {})
      : scenes_(std::move(scene), std::move(read)) {}
  /// Compiles the state, unless it is cached. Errors: as parse_edits, TimedScenes::at and
  /// compile_live.
  Result<std::shared_ptr<const TracedState>> make(const std::string& edits) override;

 private:
  TimedScenes scenes_;
  std::mutex mutex_;
  std::string edits_;
  std::shared_ptr<const TracedState> state_;
};

}  // namespace luxodus
