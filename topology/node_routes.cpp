// Why nodes need not agree on ties. Assume that all know of the same failures, and let h be the
// hops to a destination over what works. Whichever shortest path a node takes, it forwards to a
// neighbour with h - 1, so h falls at each step and a message arrives after h steps. Ties affect
// only loads.
#include "topology/node_routes.hpp"

#include <algorithm>
#include <bit>

#include "runtime/core/random.hpp"

namespace luxodus {
namespace {

constexpr uint16_t not_reached = 0xFFFF;

}  // namespace

NodeRoutes::NodeRoutes(const Graph& graph, const Routes& balanced, Vertex self)
    : graph_(graph),
      self_(self),
      balanced_port_(graph.vertices()),
      arc_works_(graph.all().arcs()),
      hops_(graph.vertices()),
      first_ports_(graph.vertices()),
      next_(graph.vertices()) {
  static_assert(limits::vertex_links <= 64, "a port is a bit of a word");
  reached_.reserve(graph.vertices());
  for (Vertex to = 0; to < graph.vertices(); ++to)
    if (to != self) balanced_port_[to] = static_cast<uint8_t>(balanced.port(self, to));
}

std::span<const std::optional<Vertex>> NodeRoutes::around(std::span<const GraphLink> failed) {
  take_out(failed);
  find_first_ports();
  std::fill(next_.begin(), next_.end(), std::nullopt);
  for (const Vertex to : reached_)
    if (to != self_) next_[to] = graph_.all().of(self_)[choose(to)];
  return next_;
}

void NodeRoutes::take_out(std::span<const GraphLink> failed) {
  std::fill(arc_works_.begin(), arc_works_.end(), uint8_t{1});
  for (const GraphLink& link : failed) {
    if (std::max(link.a, link.b) >= graph_.vertices()) continue;
    take_out_arc(link.a, link.b);
    take_out_arc(link.b, link.a);
  }
}

void NodeRoutes::take_out_arc(Vertex from, Vertex to) {
  const auto neighbours = graph_.all().of(from);
  const auto at = std::lower_bound(neighbours.begin(), neighbours.end(), to);
  if (at == neighbours.end() || *at != to) return;
  arc_works_[graph_.all().arc(from, static_cast<uint32_t>(at - neighbours.begin()))] = 0;
}

/// Breadth-first search from this node. A vertex inherits the first ports of all its nearer
/// neighbours, which are complete when its turn comes.
void NodeRoutes::find_first_ports() {
  const Adjacency& all = graph_.all();
  std::fill(hops_.begin(), hops_.end(), not_reached);
  std::fill(first_ports_.begin(), first_ports_.end(), PortSet{0});
  hops_[self_] = 0;
  reached_.assign(1, self_);
  for (size_t i = 0; i < reached_.size(); ++i) {
    const Vertex v = reached_[i];
    if (v != self_ && !graph_.forwards(v)) continue;
    const auto farther = static_cast<uint16_t>(hops_[v] + 1);
    for (uint32_t port = 0; port < all.degree(v); ++port) {
      if (arc_works_[all.arc(v, port)] == 0) continue;
      const Vertex to = all.of(v)[port];
      if (hops_[to] == not_reached) {
        hops_[to] = farther;
        reached_.push_back(to);
      }
      if (hops_[to] == farther)
        first_ports_[to] |= v == self_ ? PortSet{1} << port : first_ports_[v];
    }
  }
}

/// The balanced port if it still begins a shortest path; otherwise one by the hash of both ends, so
/// that destinations spread over the remaining ones. Requires: `to` is reached.
uint32_t NodeRoutes::choose(Vertex to) const {
  PortSet ports = first_ports_[to];
  const uint32_t balanced = balanced_port_[to];
  if ((ports >> balanced & 1) != 0) return balanced;
  const auto count = static_cast<uint32_t>(std::popcount(ports));
  if (count > 1) {
    const auto stream = static_cast<uint32_t>(RandomStream::graph);
    const uint64_t bits = philox_block({self_, stream, to, 0}, 0)[0];
    for (uint64_t skip = bits * count >> 32; skip > 0; --skip) ports &= ports - 1;
  }
  return static_cast<uint32_t>(std::countr_zero(ports));
}

}  // namespace luxodus
