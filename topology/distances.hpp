// How far it is: hops between all ordered pairs of vertices, counted for all sources at once with
// one bit for each (Nakao, Murai, Sato, "Parallelization of all-pairs-shortest-path algorithms in
// unweighted graph", HPC Asia 2020), and what no wiring can beat: the bound of Moore, for averages
// of Cerf, Cowan, Mullin and Stanton (1974), here for any degrees. Pure; any thread.
#pragma once

#include <cstdint>
#include <span>

#include "topology/graph.hpp"

namespace luxodus {

/// Over all ordered pairs of two vertices, `pairs` of them. The average path length is the rational
/// hops / pairs: exact, and so comparable.
struct PathLengths {
  uint64_t pairs = 0;
  uint64_t hops = 0;         // of the pairs that are connected
  uint64_t unconnected = 0;  // pairs
  uint32_t diameter = 0;     // of the pairs that are connected

  /// Hops a pair [1]; 0 where there is no pair.
  double average() const {
    const uint64_t counted = pairs - unconnected;
    return counted == 0 ? 0 : static_cast<double>(hops) / static_cast<double>(counted);
  }
};

PathLengths path_lengths(const Adjacency& graph);

/// A bound from below on the hops and the diameter of any graph with these degrees. At most
/// sum over v of d_v (d_v - 1)^(k-1) ordered pairs are k hops apart, since so many walks of k steps
/// that do not turn back exist at most: in the stationary walk each step leaves a vertex drawn with
/// a chance of its degree, and Hoelder's inequality bounds the mean of a product of (d - 1) by
/// the mean of its power. With equal degrees this is the bound of Moore and Cerf.
/// Requires: enough links to connect the vertices.
PathLengths hop_bound(std::span<const uint32_t> degrees);

/// The degrees of a wiring that uses as many links as there may be: `links` a node, all but one
/// where their sum is odd. A controller is the last entry, and takes its links from the nodes.
std::vector<uint32_t> full_degrees(uint32_t nodes, uint32_t links, uint32_t controller_links);
/// The same among the nodes alone: what the controller's links leave them.
std::vector<uint32_t> full_worker_degrees(uint32_t nodes, uint32_t links,
                                          uint32_t controller_links);

/// A bound from below on the hops from a controller to all nodes: as few links lead on as may.
/// Requires: controller_links > 0.
PathLengths controller_bound(uint32_t nodes, uint32_t links, uint32_t controller_links);

}  // namespace luxodus
