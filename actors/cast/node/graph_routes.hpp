// The links and routes of a run's graph as the network takes them. Thread rule: what reroute_on()
// returns belongs to one node; the rest is pure.
#pragma once

#include <vector>

#include "runtime/node/node_shell.hpp"
#include "topology/routes.hpp"

namespace luxodus {

/// All links of a graph.
std::vector<Edge> edges_of(const Graph& graph);

/// Next hops of a node on the graph around failed links. `balanced`: routes of the whole graph, if
/// they were computed once for all nodes of the process; else null. Requires: the graph outlives
/// what is returned.
Reroute reroute_on(const Graph& graph, const Routes* balanced, NodeId self);

}  // namespace luxodus
