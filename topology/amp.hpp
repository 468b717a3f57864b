// Minimum-path graphs (AMP, after Chalmers and Gregory 1993): given nodes and links a node, least
// diameter first, then least average path length. Found by simulated annealing of rotational graphs
// with 2-opt moves (Nakao, Murai, Sato, "A method for order/degree problem based on graph symmetry
// and simulated annealing", HPC Asia 2019), many short runs from different starts; of graphs that
// are equally short, the one whose heaviest link carries least and which a failure harms least is
// taken. A pure function of the request, unless `stop` ends it early, on one build: temperatures
// are floating point. What nodes must agree on is the graph's file, not the search. Any thread.
#pragma once

#include <cstdint>
#include <functional>

#include "runtime/core/result.hpp"
#include "topology/graph.hpp"

namespace luxodus {

struct AmpRequest {
  uint32_t nodes = 0;
  /// Of a node, among them one that it may have to the controller.
  uint32_t links = 4;
  /// 0: no controller. It is counted, and ranked, as one that does not forward.
  uint32_t controller_links = 0;
  bool controller_forwards = false;
  uint64_t seed = 0;
  /// Annealing runs; 0: so many as are useful for the size. The search ends sooner where it has
  /// compared enough graphs that meet the bound.
  uint32_t runs = 0;
};

struct AmpFound {
  Graph graph;
  uint32_t runs = 0;
  uint64_t moves = 0;
};

/// The best graph found. `stop` is asked every few thousand moves whether to end with what there
/// is. Errors: no graph has so few links, or the sizes leave the limits.
Result<AmpFound> find_amp(const AmpRequest& request, const std::function<bool()>& stop);

}  // namespace luxodus
