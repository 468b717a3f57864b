// Minimum-path graphs (AMP, after Chalmers and Gregory 1993): for given nodes and links per node,
// least diameter first, then least average path length. Found by simulated annealing of rotational
// graphs with 2-opt moves (Nakao, Murai, Sato, "A method for order/degree problem based on graph
// symmetry and simulated annealing", HPC Asia 2019), in many short runs from different starts.
// Among equally short graphs it takes the one with the lightest heaviest link and the least damage
// from a failure. A pure function of the request on one build, unless `stop` ends it early:
// temperatures are floating point, so nodes must share the graph file and not the search. Any
// thread.
#pragma once

#include <cstdint>
#include <functional>

#include "runtime/core/result.hpp"
#include "topology/graph.hpp"

namespace luxodus {

struct AmpRequest {
  uint32_t nodes = 0;
  /// Per node, including one that may go to the controller.
  uint32_t links = 4;
  /// 0: no controller. The search counts and ranks it as one that does not forward.
  uint32_t controller_links = 0;
  bool controller_forwards = false;
  uint64_t seed = 0;
  /// Annealing runs; 0: a useful number for the size. The search ends earlier once it has compared
  /// enough graphs at the bound.
  uint32_t runs = 0;
};

struct AmpFound {
  Graph graph;
  uint32_t runs = 0;
  uint64_t moves = 0;
};

/// The best graph found. `stop` is called every few thousand moves; true ends the search with the
/// best so far. Errors: no graph has so few links, or the sizes exceed the limits.
Result<AmpFound> find_amp(const AmpRequest& request, const std::function<bool()>& stop);

}  // namespace luxodus
