// Tracing of changing states of a scene by simulated nodes: the production code of all nodes in one
// thread, in virtual time, under faults. A requester goes from state to state, leaves some before
// they are done, and comes back; in the end the flux of every state equals that of the plain loop,
// bit for bit. Thread rule: one thread.
#pragma once

#include "actors/lab/simulate/simulation.hpp"

namespace luxodus {

/// The states for many simulated runs: one scene with different seeds, and the reference of each.
class SimStates {
 public:
  /// Traces the references with the plain loop. Requires: particles >= 1 for each state.
  SimStates(const std::shared_ptr<const CompiledScene>& scene, uint64_t seed, int64_t particles);

  size_t count() const { return states_.size(); }
  const SimScene& of(size_t state) const { return *states_[state]; }

 private:
  std::vector<std::unique_ptr<SimScene>> states_;
};

/// Errors: options that contradict each other or the scene.
Result<SimReport> simulate_states(const SimStates& states, const SimOptions& options);

}  // namespace luxodus
