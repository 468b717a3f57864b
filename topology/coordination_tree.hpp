// Who coordinates whom in a run on many nodes: a tree over the vertices of a graph, whose messages
// take the graph's routes. The controller is the root. Where it would lead more vertices than the
// fan-out, some of them lead the others in its stead and trace nothing: k centres by hop distance
// (Gonzalez, "Clustering to minimize the maximum intercluster distance", 1985), each with as many
// as its neighbours at most, and so on within each cluster. The same graph gives the same tree in
// every process. Immutable values; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/graph.hpp"

namespace luxodus {

namespace limits {
/// From so many workers on a run has more than one level of coordinators, unless told otherwise.
inline constexpr uint32_t workers_of_one_level = 64;
}  // namespace limits

/// The fan-out for so many workers that nobody has chosen: one level below
/// limits::workers_of_one_level, else the square root, rounded up.
uint32_t usual_fan_out(uint32_t workers);
/// The fan-out that was `asked` for; 0: as usual, or for `one_level` where there can be no more.
uint32_t chosen_fan_out(uint32_t asked, uint32_t workers, bool one_level);

class CoordinationTree {
 public:
  /// Requires: graph.has_controller(), fan_out >= 2.
  CoordinationTree(const Graph& graph, uint32_t fan_out);

  Vertex root() const { return static_cast<Vertex>(parent_.size()); }
  /// Requires: v is a worker.
  Vertex parent(Vertex v) const { return parent_[v]; }
  std::vector<Vertex> children(Vertex v) const;
  /// Levels of coordinators at and below a vertex: 0 of one that traces.
  uint32_t height(Vertex v) const { return height_[v]; }
  bool coordinates(Vertex v) const { return height(v) > 0; }
  /// Vertices that trace, at and below this one.
  uint32_t tracers(Vertex v) const { return tracers_[v]; }
  /// Whether vertices beside the root coordinate.
  bool has_levels() const { return height(root()) > 1; }

  /// By whom a worker may be coordinated: its parent, then, where that is lost, the others that
  /// stand higher than itself, the nearest first, and the root last, which nobody replaces.
  std::vector<Vertex> coordinators_of(Vertex v) const;

 private:
  void lead(const Graph& graph, Vertex leader, std::vector<Vertex> below, uint32_t fan_out);
  void measure(Vertex v);

  std::vector<Vertex> parent_;               // of workers
  std::vector<uint32_t> height_;             // of all, the root last
  std::vector<uint32_t> tracers_;            // likewise
  std::vector<std::vector<uint16_t>> hops_;  // from coordinators, by vertex; else empty
};

}  // namespace luxodus
