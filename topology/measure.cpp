#include "topology/measure.hpp"

#include <algorithm>

#include "topology/structure.hpp"

namespace luxodus {
namespace {

std::vector<GraphLink> links_of(const Adjacency& graph) {
  std::vector<GraphLink> links;
  for (Vertex v = 0; v < graph.vertices(); ++v) {
    for (const Vertex to : graph.of(v)) {
      if (v < to) links.push_back({v, to});
    }
  }
  return links;
}

void take_worse(FailureHarm& harm, const PathLengths& left) {
  harm.falls_apart = harm.falls_apart || left.unconnected > 0;
  harm.diameter = std::max(harm.diameter, left.diameter);
  harm.average = std::max(harm.average, left.average());
}

}  // namespace

FailureHarm harm_of_any_link(const Adjacency& graph) {
  FailureHarm harm;
  std::vector<GraphLink> links = links_of(graph);
  for (size_t i = 0; i < links.size(); ++i) {
    // The last link takes the index of the one that fails.
    const GraphLink failed = links[i];
    links[i] = links.back();
    take_worse(harm, path_lengths(Adjacency(graph.vertices(), {links.data(), links.size() - 1})));
    links[i] = failed;
  }
  return harm;
}

FailureHarm harm_of_any_vertex(const Adjacency& graph) {
  FailureHarm harm;
  if (graph.vertices() < 2) return harm;
  const std::vector<GraphLink> links = links_of(graph);
  for (Vertex failed = 0; failed < graph.vertices(); ++failed) {
    std::vector<GraphLink> left;
    for (const GraphLink& link : links) {
      if (link.a == failed || link.b == failed) continue;
      left.push_back({link.a - (link.a > failed ? 1 : 0), link.b - (link.b > failed ? 1 : 0)});
    }
    take_worse(harm, path_lengths(Adjacency(graph.vertices() - 1, left)));
  }
  return harm;
}

namespace {

PartMeasures measure_part(const Adjacency& graph, const std::vector<uint32_t>& full_degrees) {
  PartMeasures part;
  part.paths = path_lengths(graph);
  part.bound = hop_bound(full_degrees);
  part.edge_connectivity = edge_connectivity(graph);
  part.vertex_connectivity = vertex_connectivity(graph);
  part.girth = girth(graph);
  part.bisection_upper_bound = bisection_upper_bound(graph);
  part.any_link = harm_of_any_link(graph);
  part.any_vertex = harm_of_any_vertex(graph);
  return part;
}

PathLengths paths_from_controller(const Graph& graph, const Routes& routes) {
  PathLengths paths;
  paths.pairs = graph.workers();
  for (Vertex to = 0; to < graph.workers(); ++to) {
    const uint32_t hops = routes.hops(graph.controller(), to);
    paths.hops += hops;
    paths.diameter = std::max(paths.diameter, hops);
  }
  return paths;
}

}  // namespace

Measures measure(const Graph& graph) {
  const uint32_t nodes = graph.workers();
  const uint32_t links = graph.max_links();
  const uint32_t controller_links = graph.controller_links();
  const Routes routes = balanced_routes(graph);

  Measures measures;
  measures.all = measure_part(graph.all(), full_degrees(nodes, links, controller_links));
  measures.all_to_all = all_to_all_loads(graph, routes);
  measures.routes_hash = routes.hash();
  measures.hop_classes = routes.longest();
  uint32_t longest = std::max(
      {measures.hop_classes, measures.all.any_link.diameter, measures.all.any_vertex.diameter});
  if (graph.has_controller()) {
    measures.workers =
        measure_part(graph.among_workers(), full_worker_degrees(nodes, links, controller_links));
    measures.from_controller = paths_from_controller(graph, routes);
    measures.from_controller_bound = controller_bound(nodes, links, controller_links);
    measures.gather = gather_loads(graph, routes);
    if (graph.controller_role() == ControllerRole::endpoint) {
      longest = std::max(
          {longest, measures.workers->any_link.diameter, measures.workers->any_vertex.diameter});
    }
  }
  measures.hop_classes_after_failure = longest + 1;
  return measures;
}

}  // namespace luxodus
