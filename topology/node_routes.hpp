// The next hops of one node around failures: for every destination, the neighbour to which to
// forward. All are shortest over the links that work. Without failures they are the balanced routes
// of the whole graph; a failure changes only the routes that used the failed part. Takes one
// breadth-first search and no table of other nodes' routes; docs/decisions/0038 has the reasons.
// Nodes that know of the same failures give every message a loop-free path, however they break
// ties. It sends nothing and detects no failure. Thread rule: one thread at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "topology/routes.hpp"

namespace luxodus {

class NodeRoutes {
 public:
  /// Requires: `balanced` are the balanced routes of `graph`, which outlives this.
  NodeRoutes(const Graph& graph, const Routes& balanced, Vertex self);

  /// By destination; nothing for this node itself and for unreachable nodes. A lost node is the
  /// failure of all its links; links that are not in the graph are ignored. Allocates nothing; the
  /// result is valid until the next call.
  std::span<const std::optional<Vertex>> around(std::span<const GraphLink> failed);

 private:
  /// A set of this node's ports.
  using PortSet = uint64_t;

  void take_out(std::span<const GraphLink> failed);
  void take_out_arc(Vertex from, Vertex to);
  void find_first_ports();
  uint32_t choose(Vertex to) const;

  const Graph& graph_;
  const Vertex self_;
  std::vector<uint8_t> balanced_port_;  // by destination: without failures
  std::vector<uint8_t> arc_works_;
  std::vector<uint16_t> hops_;        // from this node
  std::vector<PortSet> first_ports_;  // by destination: ports that begin a shortest path
  std::vector<Vertex> reached_;       // nearest first
  std::vector<std::optional<Vertex>> next_;
};

}  // namespace luxodus
