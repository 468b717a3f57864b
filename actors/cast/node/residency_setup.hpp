// From a reference profile to nodes: the residency plan's inputs from a run, each node's part of
// the plan, and the table of expected and measured hit rates. Pure but for its output arguments;
// any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/cast/node/node_setup.hpp"
#include "actors/cast/node/worker.hpp"
#include "actors/cast/parts/residency.hpp"

namespace luxodus {

/// Memory limits of the workers.
struct ResidencyBudgets {
  std::vector<size_t> object_bytes;  // by worker
  double pinned_share = 0;           // largest share of it for pinned objects
  uint32_t replicas = 1;
};

/// The cache of a node with this budget. If there is no room for the pinned share beside one object
/// and one build, the share is reduced.
CacheConfig object_cache(const SceneObjects& objects, size_t object_bytes, double pinned_share);

/// Hops from one node to each node.
std::vector<uint32_t> hops_from(const Graph& graph, Vertex from);

/// The plan for a run's workers. Requires: the profile is of this scene and its objects.
Residency residency_for(const ReferenceProfile& profile, const CompiledScene& scene,
                        const SceneObjects& objects, const Graph& graph,
                        const ResidencyBudgets& budgets);

/// Applies the plan to a node; the controller gets the workers' group ranks.
void settle(NodeSetup& node, const Residency& residency);

/// Lines for people: by node, then over all reporting nodes, expected beside measured.
std::vector<std::string> residency_table(const Residency& residency,
                                         const std::vector<WorkerReport>& nodes);

}  // namespace luxodus
