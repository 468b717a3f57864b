// States of a scene that changes, traced by simulated nodes: the production code of all nodes in
// one thread, by virtual time, under faults. Somebody goes from state to state, leaves some before
// they are done, and comes back; in the end the flux of every state is that of the plain loop, bit
// for bit. Thread rule: one thread.
#pragma once

#include "actors/lab/simulate/simulation.hpp"

namespace luxodus {

/// The states for many simulated runs: the scene with seeds of its own, and what each must leave.
class SimStates {
 public:
  /// Traces the references with the plain loop. Requires: particles >= 1 of each state.
  SimStates(const std::shared_ptr<const CompiledScene>& scene, uint64_t seed, int64_t particles);

  size_t count() const { return states_.size(); }
  const SimScene& of(size_t state) const { return *states_[state]; }

 private:
  std::vector<std::unique_ptr<SimScene>> states_;
};

/// Errors: options that contradict each other or the scene.
Result<SimReport> simulate_states(const SimStates& states, const SimOptions& options);

}  // namespace luxodus
