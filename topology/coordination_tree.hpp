// The tree of coordinators in a run on many nodes, over the vertices of a graph; its messages take
// the graph's routes. The controller is the root. If it would lead more vertices than the fan-out,
// some of them lead the others in its stead and trace nothing: k centres by hop distance (Gonzalez,
// "Clustering to minimize the maximum intercluster distance", 1985), each with at most as many as
// its neighbours have, and so on within each cluster. The same graph gives the same tree in every
// process. Immutable values; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/graph.hpp"

namespace luxodus {

namespace limits {
/// From this many workers on, a run has more than one level of coordinators, unless configured.
inline constexpr uint32_t workers_of_one_level = 64;
}  // namespace limits

/// The default fan-out for this many workers: one level below limits::workers_of_one_level, else
/// the square root, rounded up.
uint32_t usual_fan_out(uint32_t workers);
/// The fan-out that was `asked` for; 0: the default, or a single level if `one_level` requires it.
uint32_t chosen_fan_out(uint32_t asked, uint32_t workers, bool one_level);

class CoordinationTree {
 public:
  /// Requires: graph.has_controller(), fan_out >= 2.
  CoordinationTree(const Graph& graph, uint32_t fan_out);

  Vertex root() const { return static_cast<Vertex>(parent_.size()); }
  /// Requires: v is a worker.
  Vertex parent(Vertex v) const { return parent_[v]; }
  std::vector<Vertex> children(Vertex v) const;
  /// Levels of coordinators at and below a vertex: 0 for a tracing vertex.
  uint32_t height(Vertex v) const { return height_[v]; }
  bool coordinates(Vertex v) const { return height(v) > 0; }
  /// Tracing vertices at and below this one.
  uint32_t tracers(Vertex v) const { return tracers_[v]; }
  /// Whether vertices other than the root coordinate.
  bool has_levels() const { return height(root()) > 1; }

  /// The coordinators of a worker in order of preference: its parent, then, if that is lost, the
  /// others that are higher than itself, the nearest first, and last the root, which nothing
  /// replaces.
  std::vector<Vertex> coordinators_of(Vertex v) const;

 private:
  void lead(const Graph& graph, Vertex leader, std::vector<Vertex> below, uint32_t fan_out);
  void measure(Vertex v);

  std::vector<Vertex> parent_;               // of workers
  std::vector<uint32_t> height_;             // of all vertices, the root last
  std::vector<uint32_t> tracers_;            // of all vertices, the root last
  std::vector<std::vector<uint16_t>> hops_;  // from coordinators, by vertex; otherwise empty
};

}  // namespace luxodus
