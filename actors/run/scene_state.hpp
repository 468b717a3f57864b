// States of a scene that changes, as those who trace elsewhere get them: a data object, named in
// leases by its hash, of which whoever knows the scene makes what can be traced.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "runtime/core/ids.hpp"
#include "runtime/core/result.hpp"
#include "scenes/transport/trace.hpp"

namespace luxodus {

/// What a state of the scene is made from by whoever traces it elsewhere: a data object.
struct StateObject {
  uint64_t seed = 0;
  std::string text;  // as whoever makes states of it has written it

  /// The hash of its bytes: names the state in leases.
  ObjectId id() const;
  std::string bytes() const;
  /// Errors: bytes that are none.
  static Result<StateObject> parse(std::span<const std::byte> bytes);

  friend bool operator==(const StateObject&, const StateObject&) = default;
};

/// A state that can be traced, with all its geometry.
struct TracedState {
  explicit TracedState(std::shared_ptr<const CompiledScene> of)
      : scene(std::move(of)), index(device, *scene) {}
  std::shared_ptr<const CompiledScene> scene;
  /// Its batches are those of a run, by their numbers (BatchPlan), with paths from the eye; else
  /// BatchRange says what they are.
  bool is_run = false;
  EmbreeDevice device;
  SceneIndex index;
};

/// Makes states of their text. The nodes of a process share one. Any thread.
class StateMaker {
 public:
  virtual ~StateMaker() = default;
  /// Errors: a text that is none, or asks for what the scene has not.
  virtual Result<std::shared_ptr<const TracedState>> make(const std::string& text) = 0;
};

}  // namespace luxodus
