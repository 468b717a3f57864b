// Next hops: at every vertex, for every destination, the neighbour to hand a message to. All routes
// are shortest, and ties are chosen so that no link carries much more than others when everyone
// talks to everyone. The same graph gives the same tables on every machine, so nobody needs to send
// them; the hash says so in the handshake. These are the routes while everything works: what a node
// does around failures is in node_routes.hpp. Immutable values; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/graph.hpp"

namespace luxodus {

class Routes {
 public:
  uint32_t vertices() const { return vertices_; }
  /// Hops from one vertex to another: there is a way, since a Graph is connected.
  uint32_t hops(Vertex from, Vertex to) const { return hops_[at(from, to)]; }
  /// The place of the next hop among the neighbours of `from`. Requires: from != to.
  uint32_t port(Vertex from, Vertex to) const { return port_[at(from, to)]; }
  /// The arc to take, as Graph::all() counts arcs. Requires: from != to.
  uint32_t next_arc(Vertex from, Vertex to) const { return first_arc_[from] + port(from, to); }
  /// The neighbour to hand to. Requires: from != to.
  Vertex next_hop(Vertex from, Vertex to) const { return target_[next_arc(from, to)]; }
  /// Hops of the longest route: so many classes of buffers keep them free of deadlock.
  uint32_t longest() const;
  /// Of the graph and the tables.
  uint64_t hash() const { return hash_; }

 private:
  friend class RouteBalancer;

  Routes() = default;
  size_t at(Vertex from, Vertex to) const { return size_t{to} * vertices_ + from; }

  uint32_t vertices_ = 0;
  std::vector<uint16_t> hops_;       // [to][from]
  std::vector<uint8_t> port_;        // [to][from]
  std::vector<uint32_t> first_arc_;  // [from]
  std::vector<Vertex> target_;       // [arc]
  uint64_t hash_ = 0;
};

/// Balanced shortest routes. Ties are broken by local search for the least sum of squared loads:
/// first of the traffic among workers, then of the traffic between them and the controller, each by
/// itself, since the one is the run and the other its beginning and end.
Routes balanced_routes(const Graph& graph);

/// Messages on the links of a graph, each link counted once for each direction.
struct LinkLoads {
  uint64_t heaviest = 0;
  uint64_t lightest = 0;
  /// No routes can have a lighter heaviest link: the mean, rounded up.
  uint64_t bound = 0;
};

/// When every worker sends one message to every other.
LinkLoads all_to_all_loads(const Graph& graph, const Routes& routes);

/// When every worker sends one message to the controller: of the controller's links.
/// Requires: graph.has_controller().
LinkLoads gather_loads(const Graph& graph, const Routes& routes);

}  // namespace luxodus
