#include "topology/builders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <set>

#include "runtime/core/random.hpp"
#include "topology/distances.hpp"

namespace luxodus {
namespace {

Result<void> check_size(uint32_t nodes) {
  if (nodes >= 1 && nodes <= limits::graph_vertices) return {};
  return problem(fmt::format("{} nodes: a graph has from 1 to {}", nodes, limits::graph_vertices));
}

/// The graph of these links; its link limit is the largest degree.
Result<Graph> graph_of(uint32_t nodes, uint32_t rotation, std::vector<GraphLink> links) {
  std::vector<uint32_t> degree(nodes);
  for (const GraphLink& link : links) {
    ++degree[link.a];
    ++degree[link.b];
  }
  GraphPlan plan{nodes, *std::max_element(degree.begin(), degree.end()), ControllerRole::none,
                 rotation, std::move(links)};
  if (const auto fault = fault_of(plan)) return problem(fault->what);
  return Graph(std::move(plan));
}

/// Links from node 0 to these distances, and all their rotations.
std::vector<GraphLink> circulant(uint32_t nodes, const std::vector<uint32_t>& distances) {
  std::vector<GraphLink> once;
  for (const uint32_t distance : distances) {
    if (distance % nodes != 0) once.push_back({0, distance % nodes});
  }
  return turned(nodes, nodes, once);
}

/// The greatest divisor up to the square root: the rows of the most nearly square grid.
uint32_t rows_of(uint32_t nodes) {
  uint32_t rows = 1;
  for (uint32_t r = 1; r * r <= nodes; ++r) {
    if (nodes % r == 0) rows = r;
  }
  return rows;
}

std::vector<GraphLink> grid(uint32_t rows, uint32_t columns, bool joined) {
  std::set<GraphLink> links;
  for (uint32_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      const Vertex here = r * columns + c;
      const Vertex right = r * columns + (c + 1) % columns;
      const Vertex below = (r + 1) % rows * columns + c;
      if (right != here && (joined || c + 1 < columns)) links.insert(link_between(here, right));
      if (below != here && (joined || r + 1 < rows)) links.insert(link_between(here, below));
    }
  }
  return {links.begin(), links.end()};
}

}  // namespace

Result<Graph> make_ring(uint32_t nodes) {
  if (auto ok = check_size(nodes); !ok) return ok.problem();
  return graph_of(nodes, nodes, circulant(nodes, {1}));
}

Result<Graph> make_mesh(uint32_t nodes) {
  if (auto ok = check_size(nodes); !ok) return ok.problem();
  const uint32_t rows = rows_of(nodes);
  return graph_of(nodes, 1, grid(rows, nodes / rows, false));
}

Result<Graph> make_torus(uint32_t nodes) {
  if (auto ok = check_size(nodes); !ok) return ok.problem();
  const uint32_t rows = rows_of(nodes);
  return graph_of(nodes, rows, grid(rows, nodes / rows, true));
}

Result<Graph> make_hypercube(uint32_t nodes) {
  if (auto ok = check_size(nodes); !ok) return ok.problem();
  if (!std::has_single_bit(nodes)) {
    return problem(fmt::format("{} is no power of two, and a hypercube is one", nodes));
  }
  std::vector<GraphLink> links;
  for (Vertex v = 0; v < nodes; ++v) {
    for (Vertex bit = 1; bit < nodes; bit *= 2) {
      if ((v & bit) == 0) links.push_back({v, v | bit});
    }
  }
  // Half a turn adds the highest bit.
  return graph_of(nodes, nodes > 1 ? 2 : 1, std::move(links));
}

Result<Graph> make_ternary_tree(uint32_t nodes) {
  if (auto ok = check_size(nodes); !ok) return ok.problem();
  std::vector<GraphLink> links;
  for (Vertex v = 1; v < nodes; ++v) links.push_back({(v - 1) / 3, v});
  return graph_of(nodes, 1, std::move(links));
}

Result<Graph> make_chordal_ring(uint32_t nodes) {
  if (auto ok = check_size(nodes); !ok) return ok.problem();
  uint64_t fewest = UINT64_MAX;
  std::vector<GraphLink> best = circulant(nodes, {1});
  for (uint32_t chord = 2; chord <= nodes / 2; ++chord) {
    std::vector<GraphLink> links = circulant(nodes, {1, chord});
    const uint64_t hops = path_lengths(Adjacency(nodes, links)).hops;
    if (hops >= fewest) continue;
    fewest = hops;
    best = std::move(links);
  }
  return graph_of(nodes, nodes, std::move(best));
}

Result<Graph> make_random_regular(uint32_t nodes, uint32_t links, uint64_t seed) {
  // Exchanges per link: after 10 no trace of the initial order is measurable.
  constexpr uint64_t exchanges_per_link = 50;
  // A random graph of 3 or more links per node is disconnected once in many thousand times.
  constexpr uint64_t max_attempts = 100;
  if (auto ok = check_size(nodes); !ok) return ok.problem();
  if (links >= nodes || links > limits::vertex_links || uint64_t{nodes} * links % 2 == 1) {
    return problem(fmt::format("no graph of {} nodes has {} links at each", nodes, links));
  }
  std::vector<uint32_t> distances;
  for (uint32_t d = 1; d <= links / 2; ++d) distances.push_back(d);
  if (links % 2 == 1) distances.push_back(nodes / 2);
  std::vector<GraphLink> list = circulant(nodes, distances);
  std::set<GraphLink> present(list.begin(), list.end());

  Random random(seed, RandomStream::graph);
  for (uint64_t attempt = 0; attempt < max_attempts; ++attempt) {
    random.start(attempt);
    for (uint64_t i = 0; i < exchanges_per_link * list.size(); ++i) {
      GraphLink& one = list[random.bits() % list.size()];
      GraphLink& other = list[random.bits() % list.size()];
      const bool crossed = (random.bits() & 1) == 1;
      const auto [c, d] = crossed ? GraphLink{other.b, other.a} : other;
      const GraphLink first = link_between(one.a, c), second = link_between(one.b, d);
      if (first.a == first.b || second.a == second.b) continue;
      if (present.contains(first) || present.contains(second)) continue;
      present.erase(one);
      present.erase(other);
      present.insert({first, second});
      one = first;
      other = second;
    }
    const GraphPlan plan{nodes, links, ControllerRole::none, 1, list};
    if (!fault_of(plan)) return Graph(plan);
  }
  return problem(
      fmt::format("no connected graph of {} nodes with {} links each was found", nodes, links));
}

Result<Graph> with_controller(const Graph& graph, uint32_t links) {
  const uint32_t workers = graph.workers();
  if (graph.has_controller()) return problem("this graph has a controller already");
  if (auto ok = check_size(workers + 1); !ok) return ok.problem();
  std::vector<GraphLink> all = graph.links();
  const uint32_t own = std::min(links, workers);
  for (uint32_t i = 0; i < own; ++i) all.push_back({i * workers / own, workers});
  std::sort(all.begin(), all.end());
  GraphPlan plan{workers, graph.max_links() + 1, ControllerRole::endpoint, 1, std::move(all)};
  if (const auto fault = fault_of(plan)) return problem(fault->what);
  return Graph(std::move(plan));
}

}  // namespace luxodus
