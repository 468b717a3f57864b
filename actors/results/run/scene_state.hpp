// States of a scene that changes, as those who trace elsewhere get them: a data object, named in
// leases by its hash, of which whoever knows the scene makes what can be traced.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "actors/results/run/particle_worker.hpp"
#include "runtime/core/ids.hpp"
#include "runtime/core/result.hpp"

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

/// A state whose batches can be done. Any thread; its workers each of one.
class TracedState {
 public:
  virtual ~TracedState() = default;
  /// Empty totals, which its batches are merged into. Requires: the state outlives them.
  virtual std::unique_ptr<Totals> totals() const = 0;
  /// `portion`, `make_tracer`: of particles. Requires: the state outlives it.
  virtual std::unique_ptr<BatchWorker> worker(uint64_t seed, int64_t portion,
                                              const TracerMaker& make_tracer) const = 0;
};

/// A scene in whose state particles are traced, with all its geometry.
class ParticleState final : public TracedState {
 public:
  ParticleState(std::shared_ptr<const CompiledScene> scene, BatchNumbers numbers)
      : scene_(std::move(scene)), index_(device_, *scene_), numbers_(numbers) {}

  std::unique_ptr<Totals> totals() const override { return empty_totals(*scene_); }
  std::unique_ptr<BatchWorker> worker(uint64_t seed, int64_t portion,
                                      const TracerMaker& make_tracer) const override {
    return std::make_unique<ParticleWorker>(*scene_, GeometryAccess::resident(index_), seed,
                                            numbers_, portion, make_tracer);
  }

 private:
  std::shared_ptr<const CompiledScene> scene_;
  EmbreeDevice device_;
  SceneIndex index_;
  const BatchNumbers numbers_;
};

/// Makes states of their text. The nodes of a process share one. Any thread.
class StateMaker {
 public:
  virtual ~StateMaker() = default;
  /// Errors: a text that is none, or asks for what the scene has not.
  virtual Result<std::shared_ptr<const TracedState>> make(const std::string& text) = 0;
};

}  // namespace luxodus
