// A run on simulated nodes: the production code of all nodes in one thread, in virtual time, under
// a fault plan. Invariants are checked after every event, and the flux is compared with the plain
// loop's, bit for bit. Thread rule: one thread.
#pragma once

#include <memory>
#include <string>

#include "actors/lab/simulate/sim_options.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// A scene for many simulated runs, and its reference result.
class SimScene {
 public:
  /// Traces the reference with the plain loop. Requires: a scene of several cells if runs fetch;
  /// particles >= 1.
  SimScene(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int64_t particles);

  const std::shared_ptr<const CompiledScene>& scene() const { return scene_; }
  uint64_t seed() const { return seed_; }
  int64_t particles() const { return particles_; }
  /// A run that has traced nothing. `resident`: with all geometry in memory.
  std::unique_ptr<LocalRun> fresh_run(bool resident) const;
  /// Errors: what differs from the plain loop's result.
  Result<void> compare(const LocalRun& run) const;

 private:
  const std::shared_ptr<const CompiledScene> scene_;
  const uint64_t seed_;
  const int64_t particles_;
  std::unique_ptr<LocalRun> reference_;
};

/// Errors: options that contradict each other or the scene.
Result<SimReport> simulate(const SimScene& scene, const SimOptions& options);

}  // namespace luxodus
