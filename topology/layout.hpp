// Where to draw the vertices so that a person sees the structure: a rotational graph on a circle
// that shows its turns, neighbours near each other; every other graph where distances on paper are
// nearest to hops. Deterministic; any thread.
#pragma once

#include <vector>

#include "topology/graph.hpp"

namespace luxodus {

/// In the unit disc, y up.
struct DrawnPlace {
  double x = 0;
  double y = 0;
};

std::vector<DrawnPlace> layout(const Graph& graph);

}  // namespace luxodus
