// Distances: hops between all ordered pairs of vertices, counted for all sources at once with one
// bit for each (Nakao, Murai, Sato, "Parallelization of all-pairs-shortest-path algorithms in
// unweighted graph", HPC Asia 2020), and lower bounds for any wiring: Moore's bound, for averages
// that of Cerf, Cowan, Mullin and Stanton (1974), here for any degrees. Pure; any thread.
#pragma once

#include <cstdint>
#include <span>

#include "topology/graph.hpp"

namespace luxodus {

/// Path lengths over all ordered pairs of two vertices, `pairs` of them. The average is the
/// rational hops / pairs: exact, and therefore comparable.
struct PathLengths {
  uint64_t pairs = 0;
  uint64_t hops = 0;         // of connected pairs
  uint64_t unconnected = 0;  // pairs
  uint32_t diameter = 0;     // of connected pairs

  /// Mean hops per pair [1]; 0 if there is no pair.
  double average() const {
    const uint64_t counted = pairs - unconnected;
    return counted == 0 ? 0 : static_cast<double>(hops) / static_cast<double>(counted);
  }
};

PathLengths path_lengths(const Adjacency& graph);

/// Lower bound on the hops and the diameter of any graph with these degrees. At most sum over v of
/// d_v (d_v - 1)^(k-1) ordered pairs are k hops apart, since at most so many walks of k steps
/// without turning back exist: in the stationary walk each step leaves a vertex drawn with
/// probability proportional to its degree, and Hoelder's inequality bounds the mean of a product of
/// (d - 1) by the mean of its power. With equal degrees this is the bound of Moore and Cerf.
/// Requires: enough links to connect the vertices.
PathLengths hop_bound(std::span<const uint32_t> degrees);

/// Degrees of a wiring that uses as many links as possible: `links` per node, for one node one less
/// if their sum is odd. A controller is the last entry, and takes its links from the nodes.
std::vector<uint32_t> full_degrees(uint32_t nodes, uint32_t links, uint32_t controller_links);
/// Degrees among the nodes alone, without the links to the controller.
std::vector<uint32_t> full_worker_degrees(uint32_t nodes, uint32_t links,
                                          uint32_t controller_links);

/// Lower bound on the hops from a controller to all nodes. Requires: controller_links > 0.
PathLengths controller_bound(uint32_t nodes, uint32_t links, uint32_t controller_links);

}  // namespace luxodus
