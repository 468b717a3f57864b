// Positions of the vertices that show the structure: a rotational graph on a circle that shows its
// symmetry, with neighbours close together; any other graph so that distances approximate hops.
// Pure and deterministic; any thread.
#pragma once

#include <vector>

#include "topology/graph.hpp"

namespace luxodus {

/// A position in the unit disc, y up.
struct DrawnPlace {
  double x = 0;
  double y = 0;
};

std::vector<DrawnPlace> layout(const Graph& graph);

}  // namespace luxodus
