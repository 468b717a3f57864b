// States of a scene that changes in time, for tracing elsewhere: a data object, named in leases by
// its hash, from which any node that knows the scene makes a traceable state. Each class states its
// thread rule; StateObject is a plain value.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "actors/results/run/particle_worker.hpp"
#include "runtime/core/ids.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// The data from which a node elsewhere makes a state of the scene.
struct StateObject {
  uint64_t seed = 0;
  std::string text;  // as written by the maker of states

  /// The hash of its bytes, which names the state in leases.
  ObjectId id() const;
  std::string bytes() const;
  /// Errors: malformed bytes.
  static Result<StateObject> parse(std::span<const std::byte> bytes);

  friend bool operator==(const StateObject&, const StateObject&) = default;
};

/// A state whose batches can be traced. Any thread; each worker belongs to one.
class TracedState {
 public:
  virtual ~TracedState() = default;
  /// Empty totals for its batches. Requires: the state outlives them.
  virtual std::unique_ptr<Totals> totals() const = 0;
  /// `portion`, `make_tracer`: for particles. Requires: the state outlives it.
  virtual std::unique_ptr<BatchWorker> worker(uint64_t seed, int64_t portion,
                                              const TracerMaker& make_tracer) const = 0;
};

/// A state of the scene in which particles are traced, with all its geometry.
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

/// Makes states from their text. The nodes of a process share one maker. Any thread.
class StateMaker {
 public:
  virtual ~StateMaker() = default;
  /// Errors: malformed text, or a request for something the scene lacks.
  virtual Result<std::shared_ptr<const TracedState>> make(const std::string& text) = 0;
};

}  // namespace luxodus
