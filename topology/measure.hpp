// What a graph is worth: how far it is, how far it must be, what holds it together, what is left
// when something fails, and what its links carry. Every figure stands beside the bound that no
// wiring of so many nodes and links can beat. Pure and deterministic; seconds for 1024 vertices.
// Any thread.
#pragma once

#include <cstdint>
#include <optional>

#include "topology/distances.hpp"
#include "topology/graph.hpp"
#include "topology/routes.hpp"

namespace luxodus {

/// The worst of many graphs, each with one thing failed.
struct FailureHarm {
  bool falls_apart = false;  // and then the rest speaks of the pairs still connected
  uint32_t diameter = 0;
  double average = 0;  // hops a pair
};

FailureHarm harm_of_any_link(const Adjacency& graph);
/// Pairs of the vertices that are left count.
FailureHarm harm_of_any_vertex(const Adjacency& graph);

/// Of one set of vertices and the links among them.
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
  /// All vertices, the controller forwarding like all others.
  PartMeasures all;
  /// With a controller: the workers, which it does not help.
  std::optional<PartMeasures> workers;
  /// With a controller: from it to the workers.
  std::optional<PathLengths> from_controller, from_controller_bound;

  /// What links carry over the balanced routes, where the controller forwards only if the graph
  /// says so.
  LinkLoads all_to_all;
  std::optional<LinkLoads> gather;  // with a controller
  /// Classes of buffers that keep routes free of deadlock: as many as the longest has hops; and
  /// with one spare after the worst failure of one link or vertex.
  uint32_t hop_classes = 0;
  uint32_t hop_classes_after_failure = 0;
  uint64_t routes_hash = 0;
};

Measures measure(const Graph& graph);

}  // namespace luxodus
