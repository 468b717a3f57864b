#include "topology/structure.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "runtime/core/random.hpp"

namespace luxodus {
namespace {

/// Unit flows between two vertices of a directed network, by augmenting paths (Ford and Fulkerson).
/// A flow is at most a vertex's degree, so few paths are searched.
class FlowNetwork {
 public:
  explicit FlowNetwork(uint32_t points) : edges_of_(points) {}

  void add(uint32_t from, uint32_t to) {
    edges_of_[from].push_back(static_cast<uint32_t>(edges_.size()));
    edges_.push_back({to, 1});
    edges_of_[to].push_back(static_cast<uint32_t>(edges_.size()));
    edges_.push_back({from, 0});
  }

  /// The maximum flow, or `enough` if the flow is at least that.
  uint32_t flow(uint32_t source, uint32_t sink, uint32_t enough) {
    for (size_t e = 0; e < edges_.size(); ++e) edges_[e].room = e % 2 == 0 ? 1 : 0;
    uint32_t found = 0;
    while (found < enough && augment(source, sink)) ++found;
    return found;
  }

 private:
  struct Edge {
    uint32_t to;
    uint32_t room;
  };

  bool augment(uint32_t source, uint32_t sink) {
    constexpr uint32_t unseen = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> came_by(edges_of_.size(), unseen);
    std::vector<uint32_t> queue{source};
    for (size_t i = 0; i < queue.size() && came_by[sink] == unseen; ++i) {
      for (const uint32_t e : edges_of_[queue[i]]) {
        const uint32_t to = edges_[e].to;
        if (edges_[e].room == 0 || to == source || came_by[to] != unseen) continue;
        came_by[to] = e;
        queue.push_back(to);
      }
    }
    if (came_by[sink] == unseen) return false;
    for (uint32_t at = sink; at != source; at = edges_[came_by[at] ^ 1].to) {
      --edges_[came_by[at]].room;
      ++edges_[came_by[at] ^ 1].room;
    }
    return true;
  }

  std::vector<Edge> edges_;  // each next to its reverse
  std::vector<std::vector<uint32_t>> edges_of_;
};

uint32_t min_degree(const Adjacency& graph) {
  uint32_t least = std::numeric_limits<uint32_t>::max();
  for (Vertex v = 0; v < graph.vertices(); ++v) least = std::min(least, graph.degree(v));
  return least;
}

bool linked(const Adjacency& graph, Vertex a, Vertex b) {
  const auto neighbours = graph.of(a);
  return std::binary_search(neighbours.begin(), neighbours.end(), b);
}

}  // namespace

uint32_t edge_connectivity(const Adjacency& graph) {
  FlowNetwork network(graph.vertices());
  for (Vertex v = 0; v < graph.vertices(); ++v) {
    for (const Vertex to : graph.of(v)) network.add(v, to);
  }
  // Some vertex is on the other side of the minimum cut than vertex 0.
  uint32_t least = min_degree(graph);
  for (Vertex v = 1; v < graph.vertices(); ++v) least = std::min(least, network.flow(0, v, least));
  return least;
}

uint32_t vertex_connectivity(const Adjacency& graph) {
  // A vertex is an arc from its entrance 2v to its exit 2v + 1, which one path may use.
  FlowNetwork network(2 * graph.vertices());
  for (Vertex v = 0; v < graph.vertices(); ++v) {
    network.add(2 * v, 2 * v + 1);
    for (const Vertex to : graph.of(v)) network.add(2 * v + 1, 2 * to);
  }
  // At least one of the first k + 1 vertices is outside a minimum cut of k.
  uint32_t least = min_degree(graph);
  for (Vertex from = 0; from <= least && from < graph.vertices(); ++from) {
    for (Vertex to = from + 1; to < graph.vertices(); ++to) {
      if (linked(graph, from, to)) continue;
      least = std::min(least, network.flow(2 * from + 1, 2 * to, least));
    }
  }
  return least;
}

std::optional<uint32_t> girth(const Adjacency& graph) {
  constexpr uint32_t unseen = std::numeric_limits<uint32_t>::max();
  uint32_t shortest = unseen;
  for (Vertex root = 0; root < graph.vertices(); ++root) {
    std::vector<uint32_t> hops(graph.vertices(), unseen);
    std::vector<Vertex> parent(graph.vertices(), root);
    std::vector<Vertex> queue{root};
    hops[root] = 0;
    for (size_t i = 0; i < queue.size(); ++i) {
      const Vertex v = queue[i];
      for (const Vertex to : graph.of(v)) {
        if (hops[to] == unseen) {
          hops[to] = hops[v] + 1;
          parent[to] = v;
          queue.push_back(to);
        } else if (parent[v] != to) {
          // A closed walk; from some root it is the shortest cycle itself.
          shortest = std::min(shortest, hops[v] + hops[to] + 1);
        }
      }
    }
  }
  if (shortest == unseen) return std::nullopt;
  return shortest;
}

namespace {

/// Two halves of a graph, and the gain of moving each vertex to the other half.
class Halves {
 public:
  Halves(const Adjacency& graph, std::vector<bool> right)
      : graph_(graph), right_(std::move(right)), gain_(graph.vertices()) {
    for (Vertex v = 0; v < graph.vertices(); ++v) {
      for (const Vertex to : graph.of(v)) gain_[v] += right_[v] == right_[to] ? -1 : 1;
    }
  }

  /// One pass of Kernighan and Lin: repeatedly swaps the best unlocked pair, and keeps the best
  /// prefix of these swaps. Returns the number of links saved.
  int improve() {
    const uint32_t swaps = graph_.vertices() / 2;
    std::vector<bool> locked(graph_.vertices());
    std::vector<Vertex> moved;
    int saved = 0, best = 0;
    size_t best_length = 0;
    for (uint32_t i = 0; i < swaps; ++i) {
      for (const bool side : {false, true}) {
        const Vertex v = best_of(side, locked);
        saved += gain_[v];
        move(v);
        locked[v] = true;
        moved.push_back(v);
      }
      if (saved > best) {
        best = saved;
        best_length = moved.size();
      }
    }
    for (size_t i = moved.size(); i > best_length; --i) move(moved[i - 1]);
    return best;
  }

  uint32_t links_between() const {
    uint32_t ends = 0;
    for (Vertex v = 0; v < graph_.vertices(); ++v) {
      for (const Vertex to : graph_.of(v)) ends += right_[v] != right_[to] ? 1 : 0;
    }
    return ends / 2;
  }

 private:
  /// The vertex of the half `side` with the greatest gain. Requires: one is not locked.
  Vertex best_of(bool side, const std::vector<bool>& locked) const {
    std::optional<Vertex> best;
    for (Vertex v = 0; v < graph_.vertices(); ++v) {
      if (locked[v] || right_[v] != side) continue;
      if (!best || gain_[v] > gain_[*best]) best = v;
    }
    return *best;
  }

  void move(Vertex v) {
    right_[v] = !right_[v];
    gain_[v] = -gain_[v];
    for (const Vertex to : graph_.of(v)) gain_[to] += right_[v] == right_[to] ? -2 : 2;
  }

  const Adjacency& graph_;
  std::vector<bool> right_;
  std::vector<int> gain_;
};

}  // namespace

uint32_t bisection_upper_bound(const Adjacency& graph) {
  // More starts find nothing better on the shipped graphs of 32; large graphs cost n^2 per pass.
  constexpr uint64_t starts = 24;
  const uint32_t n = graph.vertices();
  uint32_t fewest = std::numeric_limits<uint32_t>::max();
  for (uint64_t start = 0; start < starts; ++start) {
    Random random(0, RandomStream::graph);
    random.start(start);
    std::vector<Vertex> order(n);
    std::iota(order.begin(), order.end(), Vertex{0});
    // The first start keeps the numbers' order, in which a mesh is cut well.
    for (uint32_t i = n; start > 0 && i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
    std::vector<bool> right(n);
    for (uint32_t i = 0; i < n / 2; ++i) right[order[i]] = true;
    Halves halves(graph, std::move(right));
    while (halves.improve() > 0) {
    }
    fewest = std::min(fewest, halves.links_between());
  }
  return fewest;
}

}  // namespace luxodus
