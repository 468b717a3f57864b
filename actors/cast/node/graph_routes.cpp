#include "actors/cast/node/graph_routes.hpp"

#include <memory>

#include "topology/node_routes.hpp"

namespace luxodus {

namespace {

/// One node's routes, and room for the failed links.
class GraphRoutes {
 public:
  GraphRoutes(const Graph& graph, const Routes& balanced, NodeId self)
      : vertices_(graph.vertices()), routes_(graph, balanced, self.value) {}

  NextHops around(std::span<const Edge> down) {
    failed_.clear();
    for (const Edge& edge : down) failed_.push_back({edge.a.value, edge.b.value});
    NextHops hops;
    hops.next.reserve(vertices_);
    for (const std::optional<Vertex> next : routes_.around(failed_))
      hops.next.push_back(next ? NodeId{static_cast<uint16_t>(*next)} : no_node);
    return hops;
  }

 private:
  const size_t vertices_;
  NodeRoutes routes_;
  std::vector<GraphLink> failed_;
};

}  // namespace

std::vector<Edge> edges_of(const Graph& graph) {
  std::vector<Edge> edges;
  for (const GraphLink& link : graph.links()) {
    edges.push_back({NodeId{static_cast<uint16_t>(link.a)}, NodeId{static_cast<uint16_t>(link.b)}});
  }
  return edges;
}

Reroute reroute_on(const Graph& graph, const Routes* balanced, NodeId self) {
  const auto routes = std::make_shared<GraphRoutes>(
      graph, balanced != nullptr ? *balanced : balanced_routes(graph), self);
  return [routes](std::span<const Edge> down) { return routes->around(down); };
}

}  // namespace luxodus
