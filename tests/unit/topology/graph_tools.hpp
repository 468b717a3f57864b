// Shared by tests of graphs: a plain breadth-first search to check the fast counting against, and
// short ways to make graphs. Pure.
#pragma once

#include <algorithm>
#include <vector>

#include "topology/distances.hpp"
#include "topology/graph.hpp"

namespace luxodus::test {

inline Graph graph(uint32_t workers, uint32_t max_links, std::vector<GraphLink> links,
                   ControllerRole role = ControllerRole::none) {
  return Graph({workers, max_links, role, 1, std::move(links)});
}

/// Never stops a search.
inline bool never_stop() {
  return false;
}

/// Hops from one vertex to all, by breadth-first search; -1 if unreachable. A vertex that does not
/// forward is reached, but nothing is reached through it.
inline std::vector<int> hops_from(const Graph& graph, Vertex from) {
  std::vector<int> hops(graph.vertices(), -1);
  std::vector<Vertex> queue{from};
  hops[from] = 0;
  for (size_t i = 0; i < queue.size(); ++i) {
    if (queue[i] != from && !graph.forwards(queue[i])) continue;
    for (const Vertex to : graph.all().of(queue[i])) {
      if (hops[to] >= 0) continue;
      hops[to] = hops[queue[i]] + 1;
      queue.push_back(to);
    }
  }
  return hops;
}

/// The results of path_lengths(graph.all()), one source after another.
inline PathLengths plain_path_lengths(const Graph& graph) {
  PathLengths lengths;
  for (Vertex from = 0; from < graph.vertices(); ++from) {
    for (const int hops : hops_from(graph, from)) {
      if (hops == 0) continue;
      ++lengths.pairs;
      if (hops < 0) ++lengths.unconnected;
      if (hops > 0) lengths.hops += static_cast<uint64_t>(hops);
      lengths.diameter = std::max(lengths.diameter, static_cast<uint32_t>(std::max(hops, 0)));
    }
  }
  return lengths;
}

}  // namespace luxodus::test
