// Properties of a graph: distances, connectivity, robustness against failures, and link loads.
// Every figure comes with the bound that no wiring of this many nodes and links can beat. Pure and
// deterministic; any thread. Takes seconds for 1024 vertices.
#pragma once

#include <cstdint>
#include <optional>

#include "topology/distances.hpp"
#include "topology/graph.hpp"
#include "topology/routes.hpp"

namespace luxodus {

/// The worst case over many graphs, each with one failure.
struct FailureHarm {
  bool falls_apart = false;  // then the other figures count only connected pairs
  uint32_t diameter = 0;
  double average = 0;  // hops per pair
};

FailureHarm harm_of_any_link(const Adjacency& graph);
/// Counts pairs of the remaining vertices.
FailureHarm harm_of_any_vertex(const Adjacency& graph);

/// Properties of one set of vertices and the links among them.
struct PartMeasures {
  PathLengths paths;
  PathLengths bound;
  uint32_t edge_connectivity = 0;
  uint32_t vertex_connectivity = 0;
  std::optional<uint32_t> girth;  // none: a tree
  uint32_t bisection_upper_bound = 0;
  FailureHarm any_link;
  FailureHarm any_vertex;
};

struct Measures {
  /// All vertices; the controller forwards like all others.
  PartMeasures all;
  /// With a controller: the workers without its help.
  std::optional<PartMeasures> workers;
  /// With a controller: from it to the workers.
  std::optional<PathLengths> from_controller, from_controller_bound;

  /// Link loads over the balanced routes; the controller forwards only if the graph says so.
  LinkLoads all_to_all;
  std::optional<LinkLoads> gather;  // with a controller
  /// Buffer classes that keep routes free of deadlock: the hops of the longest; and one more than
  /// after the worst failure of one link or vertex.
  uint32_t hop_classes = 0;
  uint32_t hop_classes_after_failure = 0;
  uint64_t routes_hash = 0;
};

Measures measure(const Graph& graph);

}  // namespace luxodus
