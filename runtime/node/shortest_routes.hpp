// Routes over the links of an application: shortest paths, found by breadth-first search whenever a
// link fails or comes back. Pure; any thread.
#pragma once

#include <span>
#include <vector>

#include "runtime/net/net_config.hpp"

namespace luxodus {

/// A link between any two nodes.
std::vector<Edge> all_pairs(size_t nodes);

/// Next hops from `self` without the links that are down; of equally short ways the one by the
/// neighbour with the smallest number. Requires: links name nodes below `nodes`.
NextHops shortest_routes(NodeId self, size_t nodes, std::span<const Edge> links,
                         std::span<const Edge> down);

/// Links on the longest of all shortest paths; 0 if some node cannot be reached.
size_t longest_route(size_t nodes, std::span<const Edge> links);

}  // namespace luxodus
