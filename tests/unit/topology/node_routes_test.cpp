// Every node computes its next hops by itself; together they must form paths. Failures are drawn at
// random: LUXODUS_SEED draws others.
#include "topology/node_routes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <set>

#include "runtime/core/random.hpp"
#include "tests/unit/topology/graph_tools.hpp"
#include "topology/builders.hpp"
#include "topology/shipped.hpp"

using namespace luxodus;

namespace {

using Links = std::vector<GraphLink>;

/// All nodes of a graph, each with its own next hops.
class AllNodes {
 public:
  explicit AllNodes(const Graph& graph) : graph_(graph), balanced_(balanced_routes(graph)) {
    for (Vertex v = 0; v < graph.vertices(); ++v) nodes_.emplace_back(graph, balanced_, v);
  }
  /// Tells every node of the failures.
  void fail(const Links& failed) {
    next_.clear();
    for (NodeRoutes& node : nodes_) {
      const auto next = node.around(failed);
      next_.emplace_back(next.begin(), next.end());
    }
  }
  const Routes& balanced() const { return balanced_; }
  std::optional<Vertex> next_hop(Vertex from, Vertex to) const { return next_[from][to]; }
  std::vector<std::vector<std::optional<Vertex>>> tables() const { return next_; }

  /// Checks that every message arrives after as many steps as a shortest path around `failed` has,
  /// over working links and forwarding vertices; an unreachable destination has no next hop.
  void check_ways(const Links& failed) const {
    for (Vertex from = 0; from < graph_.vertices(); ++from) {
      const std::vector<int> hops = hops_around(from, failed);
      for (Vertex to = 0; to < graph_.vertices(); ++to) {
        INFO(from << " to " << to);
        if (from == to || hops[to] < 0) {
          REQUIRE_FALSE(next_hop(from, to));
          continue;
        }
        Vertex at = from;
        for (int step = 0; step < hops[to]; ++step) {
          REQUIRE((at == from || graph_.forwards(at)));
          REQUIRE(next_hop(at, to));
          const Vertex next = *next_hop(at, to);
          REQUIRE(works(link_between(at, next), failed));
          at = next;
        }
        REQUIRE(at == to);
      }
    }
  }

  /// Whether the balanced route avoids all of `failed`.
  bool balanced_route_works(Vertex from, Vertex to, const Links& failed) const {
    for (Vertex at = from; at != to;) {
      const Vertex next = balanced_.next_hop(at, to);
      if (!works(link_between(at, next), failed)) return false;
      at = next;
    }
    return true;
  }

 private:
  bool works(GraphLink link, const Links& failed) const {
    return std::binary_search(graph_.links().begin(), graph_.links().end(), link) &&
           std::count(failed.begin(), failed.end(), link) == 0;
  }
  /// -1 if unreachable. The rest need not be connected, as a Graph must be.
  std::vector<int> hops_around(Vertex from, const Links& failed) const {
    std::vector<int> hops(graph_.vertices(), -1);
    std::vector<Vertex> queue{from};
    hops[from] = 0;
    for (size_t i = 0; i < queue.size(); ++i) {
      if (queue[i] != from && !graph_.forwards(queue[i])) continue;
      for (Vertex to = 0; to < graph_.vertices(); ++to) {
        if (hops[to] >= 0 || to == queue[i] || !works(link_between(queue[i], to), failed)) continue;
        hops[to] = hops[queue[i]] + 1;
        queue.push_back(to);
      }
    }
    return hops;
  }

  const Graph& graph_;
  const Routes balanced_;
  std::vector<NodeRoutes> nodes_;
  std::vector<std::vector<std::optional<Vertex>>> next_;
};

/// Draws failures.
class Chance {
 public:
  Chance() : seed_(seed_said()), random_(seed_, RandomStream::test) { random_.start(0); }
  uint64_t seed() const { return seed_; }

  uint32_t below(size_t end) { return static_cast<uint32_t>(uint64_t{random_.bits()} * end >> 32); }
  /// `count` links, possibly with duplicates.
  Links links(const Graph& graph, uint32_t count) {
    Links links;
    while (links.size() < count) links.push_back(graph.links()[below(graph.links().size())]);
    return links;
  }

 private:
  static uint64_t seed_said() {
    const char* said = std::getenv("LUXODUS_SEED");
    return said != nullptr ? std::strtoull(said, nullptr, 10) : 1;
  }
  const uint64_t seed_;
  Random random_;
};

Links links_of(const Graph& graph, Vertex node) {
  Links links;
  for (const Vertex to : graph.all().of(node)) links.push_back(link_between(node, to));
  return links;
}

/// Regular and irregular graphs, with and without a controller, with and without spare links.
std::vector<Graph> graphs() {
  std::vector<Graph> all{*shipped_graph({32, 4, 0}),
                         *shipped_graph({32, 4, 4}, ControllerRole::endpoint),
                         *shipped_graph({32, 4, 4}, ControllerRole::forwards),
                         make_ternary_tree(20).value(),
                         make_mesh(15).value(),
                         make_ring(9).value(),
                         make_hypercube(16).value(),
                         make_ring(2).value(),
                         make_ring(1).value()};
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const Graph random = make_random_regular(24, 3, seed).value();
    all.push_back(with_controller(random, 3).value());
    all.push_back(random);
  }
  return all;
}

}  // namespace

TEST_CASE("without failures each node has its row of the balanced routes",
          "[topology][node_routes]") {
  for (const Graph& graph : graphs()) {
    AllNodes nodes(graph);
    nodes.fail({});
    for (Vertex from = 0; from < graph.vertices(); ++from)
      for (Vertex to = 0; to < graph.vertices(); ++to)
        if (from != to) REQUIRE(nodes.next_hop(from, to) == nodes.balanced().next_hop(from, to));
  }
}

TEST_CASE("after any link failures every message takes a shortest remaining path",
          "[topology][node_routes]") {
  Chance chance;
  INFO("seed " << chance.seed());
  for (const Graph& graph : graphs()) {
    AllNodes nodes(graph);
    const auto links = static_cast<uint32_t>(graph.links().size());
    if (links == 0) continue;
    for (const uint32_t count : {1u, 1u, 2u, 3u, links / 4, links / 2, links}) {
      const Links failed = chance.links(graph, count);
      nodes.fail(failed);
      nodes.check_ways(failed);
    }
  }
}

TEST_CASE("around any lost nodes the others keep shortest routes", "[topology][node_routes]") {
  Chance chance;
  INFO("seed " << chance.seed());
  const Graph graph = *shipped_graph({32, 4, 4}, ControllerRole::endpoint);
  AllNodes nodes(graph);
  for (uint32_t lost = 1; lost <= 6; ++lost) {
    std::set<Vertex> gone{graph.controller()};
    Links failed = links_of(graph, graph.controller());
    while (gone.size() < lost) {
      const Vertex node = chance.below(graph.workers());
      if (!gone.insert(node).second) continue;
      const Links more = links_of(graph, node);
      failed.insert(failed.end(), more.begin(), more.end());
    }
    nodes.fail(failed);
    nodes.check_ways(failed);
    for (const Vertex node : gone) CHECK_FALSE(nodes.next_hop((node + 1) % 32, node));
  }
}

TEST_CASE("a route that avoids all failures is unchanged", "[topology][node_routes]") {
  Chance chance;
  INFO("seed " << chance.seed());
  const Graph graph = *shipped_graph({64, 4, 4}, ControllerRole::endpoint);
  AllNodes nodes(graph);
  for (const uint32_t count : {1u, 3u, 10u}) {
    const Links failed = chance.links(graph, count);
    nodes.fail(failed);
    size_t stayed = 0;
    for (Vertex from = 0; from < graph.vertices(); ++from)
      for (Vertex to = 0; to < graph.vertices(); ++to) {
        if (from == to || !nodes.balanced_route_works(from, to, failed)) continue;
        REQUIRE(nodes.next_hop(from, to) == nodes.balanced().next_hop(from, to));
        ++stayed;
      }
    CHECK(stayed > 0);
  }
}

TEST_CASE("routes depend on the present failures, not on earlier ones", "[topology][node_routes]") {
  Chance chance;
  INFO("seed " << chance.seed());
  const Graph graph = *shipped_graph({32, 4, 4}, ControllerRole::endpoint);
  AllNodes nodes(graph);
  nodes.fail({});
  const auto at_first = nodes.tables();
  Links failed = chance.links(graph, 5);
  nodes.fail(failed);
  const auto around = nodes.tables();
  CHECK(around != at_first);
  nodes.fail(chance.links(graph, 20));
  std::reverse(failed.begin(), failed.end());
  nodes.fail(failed);
  CHECK(nodes.tables() == around);
  nodes.fail({});
  CHECK(nodes.tables() == at_first);
}

TEST_CASE("if failures disconnect the graph, its parts keep their routes",
          "[topology][node_routes]") {
  const Graph path = test::graph(4, 2, {{0, 1}, {1, 2}, {2, 3}});
  AllNodes nodes(path);
  nodes.fail({{1, 2}});
  CHECK(nodes.next_hop(0, 1) == Vertex{1});
  CHECK(nodes.next_hop(3, 2) == Vertex{2});
  CHECK_FALSE(nodes.next_hop(0, 3));
  CHECK_FALSE(nodes.next_hop(1, 2));
}

TEST_CASE("failures of links that are not in the graph change nothing", "[topology][node_routes]") {
  const Graph graph = make_ring(6).value();
  AllNodes nodes(graph);
  nodes.fail({{0, 3}, {2, 99}});
  nodes.check_ways({});
}

TEST_CASE("around a failure the heaviest load grows by at most half", "[topology][node_routes]") {
  const Graph graph = *shipped_graph({64, 4, 0});
  AllNodes nodes(graph);
  const uint64_t before = all_to_all_loads(graph, nodes.balanced()).heaviest;
  for (size_t i = 0; i < graph.links().size(); i += 16) {
    nodes.fail({graph.links()[i]});
    std::vector<uint64_t> load(size_t{graph.vertices()} * graph.vertices());
    for (Vertex from = 0; from < graph.workers(); ++from)
      for (Vertex to = 0; to < graph.workers(); ++to)
        for (Vertex at = from; at != to; at = *nodes.next_hop(at, to))
          ++load[size_t{at} * graph.vertices() + *nodes.next_hop(at, to)];
    CHECK(*std::max_element(load.begin(), load.end()) <= before + before / 2);
  }
}
