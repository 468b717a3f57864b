// Draws the nodes' configuration of a simulated run from its seed. Thread rule: one thread.
#pragma once

#include <vector>

#include "actors/lab/simulate/sim_options.hpp"

namespace luxodus {

/// Options of the nodes. The draws depend only on the seed and the scene.
NodesOptions drawn_nodes(const CompiledScene& scene, const SimOptions& options);

/// The faults of a run: those of the plan, a quiet rack's, or drawn ones. `spared`: nodes that
/// drawn faults never crash.
FaultPlan faults_of(const SimOptions& options, const RunSetup& run,
                    const std::vector<NodeId>& spared);

/// The setups of all nodes, with extreme settings that make rare paths frequent.
class DrawnSetups {
 public:
  DrawnSetups(const PlannedNodes& nodes, const CompiledScene& scene, const SimOptions& options,
              const SimCosts& costs, const FaultPlan& faults);
  DrawnSetups(const DrawnSetups&) = delete;
  DrawnSetups& operator=(const DrawnSetups&) = delete;

  NodeSetup& of(NodeId node) { return setups_[node.value]; }
  size_t count() const { return setups_.size(); }
  NodeId controller() const { return {static_cast<uint16_t>(setups_.size() - 1)}; }
  /// The setup of a node's n-th life, counted from 0.
  NodeSetup& of_life(NodeId node, uint32_t life);
  /// Number of rare paths taken by all nodes.
  uint64_t rare_ways_taken() const;

 private:
  const uint64_t seed_;
  std::vector<NodeSetup> setups_;   // the controller's is the last
  std::vector<Buggify> rare_ways_;  // per node, for all its lives
};

}  // namespace luxodus
