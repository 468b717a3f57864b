// From a profile to nodes that live by it: what the plan of residency must know of a run, what each
// node's setup takes from the plan, and the table that holds what was expected against what came.
// Pure but for what it is given; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/cast/node/node_setup.hpp"
#include "actors/cast/node/worker.hpp"
#include "actors/cast/parts/residency.hpp"

namespace luxodus {

/// What the workers may hold.
struct ResidencyBudgets {
  std::vector<size_t> object_bytes;  // by worker
  double pinned_share = 0;           // of it, at most
  uint32_t replicas = 1;
};

/// The cache of a node with this budget. Where that has no room for so many pins beside one object
/// and one build, fewer may be pinned.
CacheConfig object_cache(const SceneObjects& objects, size_t object_bytes, double pinned_share);

/// Links from one node to each node on the shortest way.
std::vector<uint32_t> hops_from(const Graph& graph, Vertex from);

/// The plan for a run's workers. Requires: the profile is of this scene and its objects.
Residency residency_for(const ReferenceProfile& profile, const CompiledScene& scene,
                        const SceneObjects& objects, const Graph& graph,
                        const ResidencyBudgets& budgets);

/// Gives a node its part of the plan; the controller takes whom to lend what.
void settle(NodeSetup& node, const Residency& residency);

/// Lines for people: by node, then of all that report, expected beside measured.
std::vector<std::string> residency_table(const Residency& residency,
                                         const std::vector<WorkerReport>& nodes);

}  // namespace luxodus
