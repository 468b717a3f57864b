// The next hops of one node around what has failed: for every destination, the neighbour to hand a
// message to. All are shortest over the links that work. With no failure they are the balanced
// routes of the whole graph; a failure moves only the routes that used what failed. It takes one
// breadth-first search and no table of others' routes. docs/decisions/0038 has the reasons.
// Nodes that know of the same failures give every message a way without a loop, whatever ties they
// break. It sends nothing and detects no failure. Thread rule: one thread at a time.
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

  /// By destination; nothing for this node itself and where no way is left. A lost node is the
  /// failure of all its links; links that the graph has not are passed over. Allocates nothing; the
  /// result holds until the next call.
  std::span<const std::optional<Vertex>> around(std::span<const GraphLink> failed);

 private:
  /// Ports of this node.
  using PortSet = uint64_t;

  void take_out(std::span<const GraphLink> failed);
  void take_out_arc(Vertex from, Vertex to);
  void find_first_ports();
  uint32_t choose(Vertex to) const;

  const Graph& graph_;
  const Vertex self_;
  std::vector<uint8_t> balanced_port_;  // by destination: where nothing has failed
  std::vector<uint8_t> arc_works_;
  std::vector<uint16_t> hops_;        // from this node
  std::vector<PortSet> first_ports_;  // by destination: that begin a shortest way
  std::vector<Vertex> reached_;       // nearest first
  std::vector<std::optional<Vertex>> next_;
};

}  // namespace luxodus
