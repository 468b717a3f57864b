#include "topology/graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runtime/core/hash.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

Adjacency::Adjacency(uint32_t vertices, std::span<const GraphLink> links)
    : first_(vertices + 1), to_(2 * links.size()) {
  for (const GraphLink& link : links) {
    ++first_[link.a + 1];
    ++first_[link.b + 1];
  }
  for (Vertex v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (const GraphLink& link : links) {
    to_[next[link.a]++] = link.b;
    to_[next[link.b]++] = link.a;
  }
  for (Vertex v = 0; v < vertices; ++v) {
    std::sort(to_.begin() + first_[v], to_.begin() + first_[v + 1]);
  }
}

namespace {

bool connected(const Adjacency& graph) {
  std::vector<bool> seen(graph.vertices());
  std::vector<Vertex> open{0};
  seen[0] = true;
  size_t found = 1;
  while (!open.empty()) {
    const Vertex v = open.back();
    open.pop_back();
    for (const Vertex to : graph.of(v)) {
      if (seen[to]) continue;
      seen[to] = true;
      ++found;
      open.push_back(to);
    }
  }
  return found == graph.vertices();
}

Result<void> check_sizes(const GraphPlan& plan, uint32_t vertices) {
  if (plan.workers == 0) return problem("a graph has at least one node");
  if (plan.workers > limits::graph_vertices || vertices > limits::graph_vertices) {
    return problem(fmt::format("{} vertices are more than {}, the most there may be", vertices,
                               limits::graph_vertices));
  }
  if (plan.max_links > limits::vertex_links) {
    return problem(fmt::format("{} links of a node are more than {}, the most there may be",
                               plan.max_links, limits::vertex_links));
  }
  if (plan.rotation == 0 || plan.workers % plan.rotation != 0) {
    return problem(
        fmt::format("rotation {} does not divide {} nodes", plan.rotation, plan.workers));
  }
  return {};
}

/// The first link that is out of range, a loop, a duplicate, or beyond its vertex's limit.
std::optional<GraphFault> fault_of_links(const GraphPlan& plan, uint32_t vertices) {
  std::vector<std::vector<Vertex>> neighbours(vertices);
  for (size_t i = 0; i < plan.links.size(); ++i) {
    const auto [a, b] = plan.links[i];
    if (a >= vertices || b >= vertices) {
      return GraphFault{
          fmt::format("there is no vertex {}; they go from 0 to {}", std::max(a, b), vertices - 1),
          i};
    }
    if (a == b) return GraphFault{fmt::format("a link from {} to itself is none", a), i};
    const auto& known = neighbours[a];
    if (std::find(known.begin(), known.end(), b) != known.end()) {
      return GraphFault{fmt::format("the link between {} and {} is there already", a, b), i};
    }
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
    for (const Vertex v : {a, b}) {
      const uint32_t most = v < plan.workers ? plan.max_links : limits::vertex_links;
      if (neighbours[v].size() > most) {
        return GraphFault{fmt::format("vertex {} has more than {} links", v, most), i};
      }
    }
  }
  return std::nullopt;
}

std::vector<GraphLink> ordered(std::vector<GraphLink> links) {
  for (GraphLink& link : links) link = link_between(link.a, link.b);
  std::sort(links.begin(), links.end());
  return links;
}

}  // namespace

std::optional<GraphFault> fault_of(const GraphPlan& plan) {
  const bool controller = plan.controller != ControllerRole::none;
  const uint32_t vertices = plan.workers + (controller ? 1 : 0);
  if (auto ok = check_sizes(plan, vertices); !ok)
    return GraphFault{ok.problem().what, std::nullopt};
  if (auto link = fault_of_links(plan, vertices)) return link;

  if (!connected(Adjacency(vertices, plan.links))) {
    return GraphFault{"not every vertex can be reached from every other", std::nullopt};
  }
  if (plan.controller == ControllerRole::endpoint &&
      !connected(Adjacency(plan.workers, links_among(plan.workers, plan.links)))) {
    return GraphFault{"without the controller, which forwards nothing, the nodes fall apart",
                      std::nullopt};
  }
  if (turned(plan.workers, plan.rotation, plan.links) != ordered(plan.links)) {
    return GraphFault{fmt::format("turned by 1/{}, the links are not the same", plan.rotation),
                      std::nullopt};
  }
  return std::nullopt;
}

std::vector<GraphLink> links_among(uint32_t workers, std::span<const GraphLink> links) {
  std::vector<GraphLink> among;
  for (const GraphLink& link : links) {
    if (std::max(link.a, link.b) < workers) among.push_back(link);
  }
  return among;
}

std::vector<GraphLink> turned(uint32_t workers, uint32_t rotation,
                              std::span<const GraphLink> links) {
  const uint32_t step = workers / rotation;
  const auto turn = [&](Vertex v, uint32_t by) {
    return v < workers ? (v + by * step) % workers : v;
  };
  std::vector<GraphLink> all;
  all.reserve(links.size() * rotation);
  for (const GraphLink& link : links) {
    for (uint32_t by = 0; by < rotation; ++by) {
      all.push_back(link_between(turn(link.a, by), turn(link.b, by)));
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

namespace {

GraphPlan checked(GraphPlan plan) {
  if (const auto fault = fault_of(plan)) throw std::invalid_argument("no graph: " + fault->what);
  plan.links = ordered(std::move(plan.links));
  return plan;
}

}  // namespace

Graph::Graph(GraphPlan plan) : plan_(checked(std::move(plan))), all_(vertices(), plan_.links) {}

Adjacency Graph::among_workers() const {
  return Adjacency(workers(), links_among(workers(), links()));
}

uint64_t Graph::hash() const {
  Hasher hasher;
  for (const uint64_t number :
       {uint64_t{workers()}, uint64_t{max_links()}, static_cast<uint64_t>(controller_role()),
        uint64_t{rotation()}, uint64_t{links().size()}}) {
    hasher.add(number);
  }
  for (const GraphLink& link : links()) hasher.add(uint64_t{link.a} << 32 | link.b);
  return hasher.value();
}

}  // namespace luxodus
