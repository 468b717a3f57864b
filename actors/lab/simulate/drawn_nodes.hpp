// What the nodes of a simulated run are like, drawn from its seed. Thread rule: one thread.
#pragma once

#include <vector>

#include "actors/lab/simulate/sim_options.hpp"

namespace luxodus {

/// What nodes are made from. The draws depend on the seed and the scene alone.
NodesOptions drawn_nodes(const CompiledScene& scene, const SimOptions& options);

/// The faults of a run: those of the plan, or a quiet rack's, or drawn. `spared`: nodes that are
/// never crashed by what is drawn.
FaultPlan faults_of(const SimOptions& options, const RunSetup& run,
                    const std::vector<NodeId>& spared);

/// The setups of all nodes, with habits that make seldom ways frequent.
class DrawnSetups {
 public:
  DrawnSetups(const PlannedNodes& nodes, const CompiledScene& scene, const SimOptions& options,
              const SimCosts& costs, const FaultPlan& faults);
  DrawnSetups(const DrawnSetups&) = delete;
  DrawnSetups& operator=(const DrawnSetups&) = delete;

  NodeSetup& of(NodeId node) { return setups_[node.value]; }
  size_t count() const { return setups_.size(); }
  NodeId controller() const { return {static_cast<uint16_t>(setups_.size() - 1)}; }
  /// Of its n-th life, 0 at first.
  NodeSetup& of_life(NodeId node, uint32_t life);
  /// Rare ways that were taken on purpose, by all.
  uint64_t rare_ways_taken() const;

 private:
  const uint64_t seed_;
  std::vector<NodeSetup> setups_;   // the controller's is the last
  std::vector<Buggify> rare_ways_;  // of each, of all its lives
};

}  // namespace luxodus
