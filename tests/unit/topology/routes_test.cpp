#include "topology/routes.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/unit/topology/graph_tools.hpp"
#include "topology/builders.hpp"
#include "topology/shipped.hpp"

using namespace luxodus;

namespace {

Graph amp32() {
  return *shipped_graph({32, 4, 0});
}
Graph amp32_with_controller(ControllerRole role = ControllerRole::endpoint) {
  return *shipped_graph({32, 4, 4}, role);
}

/// The graph as it is without what failed, vertices kept.
Graph without(const Graph& graph, const Failures& failures) {
  std::vector<GraphLink> left;
  for (const GraphLink& link : graph.links()) {
    if (std::count(failures.links.begin(), failures.links.end(), link) == 0) left.push_back(link);
  }
  return Graph({graph.workers(), graph.max_links(), graph.controller_role(), 1, left});
}

/// Follows every route of `routes` and checks that it takes as many steps as the nearest way in
/// `truth`, over links that work, through vertices that forward.
void check_routes(const Graph& truth, const Routes& routes) {
  for (Vertex from = 0; from < truth.vertices(); ++from) {
    const std::vector<int> hops = test::hops_from(truth, from);
    for (Vertex to = 0; to < truth.vertices(); ++to) {
      INFO(from << " to " << to);
      REQUIRE(routes.hops(from, to) == static_cast<uint32_t>(hops[to]));
      Vertex at = from;
      for (int step = 0; step < hops[to]; ++step) {
        REQUIRE((at == from || truth.forwards(at)));
        const Vertex next = *routes.next_hop(at, to);
        const auto neighbours = truth.all().of(at);
        REQUIRE(std::count(neighbours.begin(), neighbours.end(), next) == 1);
        at = next;
      }
      REQUIRE(at == to);
    }
  }
}

}  // namespace

TEST_CASE("every route is a shortest one and ends where it should", "[topology][routes]") {
  for (const Graph& graph :
       {amp32(), amp32_with_controller(), amp32_with_controller(ControllerRole::forwards),
        make_ternary_tree(30).value(), make_ring(1).value(), make_ring(2).value()}) {
    check_routes(graph, balanced_routes(graph));
  }
}

TEST_CASE("32 nodes with 4 links carry at most 19 messages on a link, the bound",
          "[topology][routes]") {
  const Graph graph = amp32();
  const LinkLoads loads = all_to_all_loads(graph, balanced_routes(graph));
  CHECK(loads.bound == 19);
  CHECK(loads.heaviest == 19);
}

TEST_CASE("beside a controller the workers' heaviest link and the gather are at their bounds",
          "[topology][routes]") {
  const Graph graph = amp32_with_controller();
  const Routes routes = balanced_routes(graph);
  CHECK(all_to_all_loads(graph, routes).bound == 20);
  CHECK(all_to_all_loads(graph, routes).heaviest == 20);
  CHECK(gather_loads(graph, routes).bound == 8);
  CHECK(gather_loads(graph, routes).heaviest == 8);
}

TEST_CASE("loads count each message on each link of its way", "[topology][routes]") {
  // Over the middle link of a path of 4, 2 x 2 messages go either way; over the others 1 x 3.
  const Graph path = make_mesh(2).value();
  CHECK(all_to_all_loads(path, balanced_routes(path)).heaviest == 1);
  const Graph four = test::graph(4, 2, {{0, 1}, {1, 2}, {2, 3}});
  const LinkLoads loads = all_to_all_loads(four, balanced_routes(four));
  CHECK(loads.heaviest == 4);
  CHECK(loads.lightest == 3);
  CHECK(loads.bound == 4);
}

TEST_CASE("routes of symmetric graphs are balanced to one message above the bound",
          "[topology][routes]") {
  for (const Graph& graph : {make_hypercube(16).value(), make_torus(16).value(),
                             make_hypercube(64).value(), make_chordal_ring(31).value()}) {
    const LinkLoads loads = all_to_all_loads(graph, balanced_routes(graph));
    CHECK(loads.heaviest <= loads.bound + 1);
  }
}

TEST_CASE("the same graph and the same failures give the same tables", "[topology][routes]") {
  const Graph graph = amp32();
  const Failures failures{{7}, {graph.links()[20]}};
  CHECK(balanced_routes(graph).hash() == balanced_routes(amp32()).hash());
  CHECK(balanced_routes(graph, failures).hash() == balanced_routes(graph, failures).hash());
  CHECK(balanced_routes(graph, failures).hash() != balanced_routes(graph).hash());
  CHECK(balanced_routes(graph, {{7}, {}}).hash() != balanced_routes(graph, failures).hash());
}

TEST_CASE("after any link failed, routes are the shortest of what is left", "[topology][routes]") {
  const Graph graph = amp32_with_controller();
  for (size_t i = 0; i < graph.links().size(); i += 7) {
    const Failures failures{{}, {graph.links()[i]}};
    check_routes(without(graph, failures), balanced_routes(graph, failures));
  }
}

TEST_CASE("after a vertex failed, no route passes or reaches it and all others remain",
          "[topology][routes]") {
  const Graph graph = amp32_with_controller();
  for (const Vertex failed : {Vertex{0}, Vertex{13}, graph.controller()}) {
    const Routes routes = balanced_routes(graph, {{failed}, {}});
    for (Vertex from = 0; from < graph.vertices(); ++from) {
      for (Vertex to = 0; to < graph.vertices(); ++to) {
        if (from == to) continue;
        const bool works = from != failed && to != failed;
        REQUIRE(routes.hops(from, to).has_value() == works);
        REQUIRE(routes.next_hop(from, to).has_value() == works);
        if (works) REQUIRE(routes.next_hop(from, to) != failed);
      }
    }
    CHECK(routes.longest() <= 5);
  }
}

TEST_CASE("where a failure parts the graph, its parts keep their routes", "[topology][routes]") {
  const Graph path = test::graph(4, 2, {{0, 1}, {1, 2}, {2, 3}});
  const Routes routes = balanced_routes(path, {{}, {{1, 2}}});
  CHECK(routes.next_hop(0, 1) == Vertex{1});
  CHECK(routes.next_hop(3, 2) == Vertex{2});
  CHECK_FALSE(routes.hops(0, 3));
  CHECK_FALSE(routes.next_hop(1, 2));
  CHECK(routes.longest() == 1);
}

TEST_CASE("failures of what is not there change nothing but are harmless", "[topology][routes]") {
  const Graph graph = make_ring(6).value();
  CHECK(balanced_routes(graph, {{99}, {{0, 3}}}).hash() == balanced_routes(graph).hash());
}
