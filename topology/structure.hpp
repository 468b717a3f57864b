// Connectivity of a graph: how many links or vertices must fail to disconnect it, its shortest
// cycle, and how many links join its halves. Pure and deterministic; any thread.
#pragma once

#include <cstdint>
#include <optional>

#include "topology/graph.hpp"

namespace luxodus {

/// The least number of links whose loss disconnects the graph (Menger: the least maximum flow); 0
/// for one vertex.
uint32_t edge_connectivity(const Adjacency& graph);

/// The least number of vertices whose loss disconnects the graph or leaves one vertex; n - 1 for a
/// complete graph (Even, "An algorithm for determining whether the connectivity of a graph is at
/// least k", SIAM J. Comput. 4, 1975).
uint32_t vertex_connectivity(const Adjacency& graph);

/// Length of the shortest cycle; nothing for a tree.
std::optional<uint32_t> girth(const Adjacency& graph);

/// Links between two halves (their sizes differ by at most one), as few as a heuristic finds: an
/// upper bound of the bisection width, which is NP-hard to compute (Kernighan and Lin 1970, from
/// several fixed starts).
uint32_t bisection_upper_bound(const Adjacency& graph);

}  // namespace luxodus
