// Next hops: at every vertex, for every destination, the neighbour to which to forward. All routes
// are shortest, and ties are broken so that link loads are balanced under all-to-all traffic. The
// same graph gives the same tables on every machine, so they are never sent; the handshake compares
// their hash. These are the routes without failures: node_routes.hpp has those around failures.
// Immutable values; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/graph.hpp"

namespace luxodus {

class Routes {
 public:
  uint32_t vertices() const { return vertices_; }
  /// Hops from one vertex to another; finite, since a Graph is connected.
  uint32_t hops(Vertex from, Vertex to) const { return hops_[at(from, to)]; }
  /// The index of the next hop among the neighbours of `from`. Requires: from != to.
  uint32_t port(Vertex from, Vertex to) const { return port_[at(from, to)]; }
  /// The arc to take, in the numbering of Graph::all(). Requires: from != to.
  uint32_t next_arc(Vertex from, Vertex to) const { return first_arc_[from] + port(from, to); }
  /// The neighbour to which to forward. Requires: from != to.
  Vertex next_hop(Vertex from, Vertex to) const { return target_[next_arc(from, to)]; }
  /// Hops of the longest route: this many buffer classes keep routes free of deadlock.
  uint32_t longest() const;
  /// Hash of the graph and the tables.
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
/// first of the traffic among workers, then of the traffic between them and the controller;
/// separately, since the one is the run and the other its beginning and end.
Routes balanced_routes(const Graph& graph);

/// Messages on the links of a graph, each direction of a link counted separately.
struct LinkLoads {
  uint64_t heaviest = 0;
  uint64_t lightest = 0;
  /// Lower bound on the heaviest link of any routes: the mean, rounded up.
  uint64_t bound = 0;
};

/// Loads when every worker sends one message to every other.
LinkLoads all_to_all_loads(const Graph& graph, const Routes& routes);

/// Loads of the controller's links when every worker sends it one message. Requires:
/// graph.has_controller().
LinkLoads gather_loads(const Graph& graph, const Routes& routes);

}  // namespace luxodus
