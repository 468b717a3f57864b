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

/// Follows every route and checks that it has as many steps as a shortest path, through forwarding
/// vertices.
void check_routes(const Graph& graph) {
  const Routes routes = balanced_routes(graph);
  for (Vertex from = 0; from < graph.vertices(); ++from) {
    const std::vector<int> hops = test::hops_from(graph, from);
    for (Vertex to = 0; to < graph.vertices(); ++to) {
      INFO(from << " to " << to);
      REQUIRE(routes.hops(from, to) == static_cast<uint32_t>(hops[to]));
      Vertex at = from;
      for (int step = 0; step < hops[to]; ++step) {
        REQUIRE((at == from || graph.forwards(at)));
        const Vertex next = routes.next_hop(at, to);
        const auto neighbours = graph.all().of(at);
        REQUIRE(std::count(neighbours.begin(), neighbours.end(), next) == 1);
        at = next;
      }
      REQUIRE(at == to);
    }
  }
}

}  // namespace

TEST_CASE("every route is shortest and ends at its destination", "[topology][routes]") {
  for (const Graph& graph :
       {amp32(), amp32_with_controller(), amp32_with_controller(ControllerRole::forwards),
        make_ternary_tree(30).value(), make_ring(1).value(), make_ring(2).value()}) {
    check_routes(graph);
  }
}

TEST_CASE("32 nodes with 4 links carry at most 19 messages on a link, which is the bound",
          "[topology][routes]") {
  const Graph graph = amp32();
  const LinkLoads loads = all_to_all_loads(graph, balanced_routes(graph));
  CHECK(loads.bound == 19);
  CHECK(loads.heaviest == 19);
}

TEST_CASE("with a controller the workers' heaviest link and the gather are at their bounds",
          "[topology][routes]") {
  const Graph graph = amp32_with_controller();
  const Routes routes = balanced_routes(graph);
  CHECK(all_to_all_loads(graph, routes).bound == 20);
  CHECK(all_to_all_loads(graph, routes).heaviest == 20);
  CHECK(gather_loads(graph, routes).bound == 8);
  CHECK(gather_loads(graph, routes).heaviest == 8);
}

TEST_CASE("loads count each message on each link of its path", "[topology][routes]") {
  // Over the middle link of a path of 4, 2 x 2 messages go either way; over the others 1 x 3.
  const Graph path = make_mesh(2).value();
  CHECK(all_to_all_loads(path, balanced_routes(path)).heaviest == 1);
  const Graph four = test::graph(4, 2, {{0, 1}, {1, 2}, {2, 3}});
  const LinkLoads loads = all_to_all_loads(four, balanced_routes(four));
  CHECK(loads.heaviest == 4);
  CHECK(loads.lightest == 3);
  CHECK(loads.bound == 4);
}

TEST_CASE("routes of symmetric graphs are balanced to within one message of the bound",
          "[topology][routes]") {
  for (const Graph& graph : {make_hypercube(16).value(), make_torus(16).value(),
                             make_hypercube(64).value(), make_chordal_ring(31).value()}) {
    const LinkLoads loads = all_to_all_loads(graph, balanced_routes(graph));
    CHECK(loads.heaviest <= loads.bound + 1);
  }
}

TEST_CASE("a graph of 1024, which is searched less, is balanced to 1 % above the bound",
          "[topology][routes]") {
  for (const Graph& graph : {make_hypercube(1024).value(), make_chordal_ring(1024).value()}) {
    const LinkLoads loads = all_to_all_loads(graph, balanced_routes(graph));
    CHECK(loads.heaviest <= loads.bound + loads.bound / 100);
  }
}

TEST_CASE("the same graph gives the same tables, and another graph different ones",
          "[topology][routes]") {
  const uint64_t hash = balanced_routes(amp32()).hash();
  CHECK(balanced_routes(amp32()).hash() == hash);
  CHECK(balanced_routes(amp32_with_controller()).hash() != hash);
}
