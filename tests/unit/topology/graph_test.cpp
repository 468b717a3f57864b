#include "topology/graph.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/unit/topology/graph_tools.hpp"

using namespace luxodus;

namespace {

std::string fault(GraphPlan plan) {
  const auto fault = fault_of(plan);
  return fault ? fault->what : "";
}

const std::vector<GraphLink> triangle{{0, 1}, {1, 2}, {0, 2}};

}  // namespace

TEST_CASE("a graph names the neighbours of each vertex in ascending order", "[topology]") {
  const Graph g = test::graph(4, 3, {{2, 0}, {0, 1}, {3, 0}, {2, 3}});
  CHECK(std::vector<Vertex>(g.all().of(0).begin(), g.all().of(0).end()) ==
        std::vector<Vertex>{1, 2, 3});
  CHECK(g.all().degree(1) == 1);
  CHECK(g.all().target(g.all().arc(3, 1)) == 2);
  CHECK(g.links() == std::vector<GraphLink>{{0, 1}, {0, 2}, {0, 3}, {2, 3}});
}

TEST_CASE("an invalid plan is rejected with the reason", "[topology]") {
  const auto none = ControllerRole::none;
  CHECK(fault({3, 2, none, 1, triangle}).empty());
  CHECK_THAT(fault({0, 2, none, 1, {}}), Catch::Contains("at least one node"));
  CHECK_THAT(fault({2000, 2, none, 1, {}}), Catch::Contains("more than 1024"));
  CHECK_THAT(fault({3, 100, none, 1, triangle}), Catch::Contains("more than 64"));
  CHECK_THAT(fault({3, 2, none, 2, triangle}), Catch::Contains("does not divide"));
  CHECK_THAT(fault({3, 2, none, 0, triangle}), Catch::Contains("does not divide"));
  CHECK_THAT(fault({3, 2, none, 1, {{0, 3}}}), Catch::Contains("no vertex 3"));
  CHECK_THAT(fault({3, 2, none, 1, {{1, 1}}}), Catch::Contains("itself"));
  CHECK_THAT(fault({3, 2, none, 1, {{0, 1}, {1, 0}}}), Catch::Contains("already"));
  CHECK_THAT(fault({3, 1, none, 1, triangle}), Catch::Contains("more than 1 links"));
  CHECK_THAT(fault({4, 2, none, 1, triangle}), Catch::Contains("reached"));
  CHECK_THAT(fault({4, 2, none, 2, {{0, 1}, {1, 2}, {2, 3}}}), Catch::Contains("not the same"));
  CHECK_THROWS_AS(Graph({3, 2, none, 1, {{1, 1}}}), std::invalid_argument);
}

TEST_CASE("a wrong link is named, and it is the first one", "[topology]") {
  const auto fault = fault_of({3, 2, ControllerRole::none, 1, {{0, 1}, {1, 2}, {2, 2}, {1, 1}}});
  REQUIRE(fault);
  CHECK(fault->link == size_t{2});
}

TEST_CASE("a controller that forwards nothing connects nothing", "[topology]") {
  const std::vector<GraphLink> star{{0, 2}, {1, 2}};
  CHECK(fault({2, 1, ControllerRole::forwards, 1, star}).empty());
  CHECK_THAT(fault({2, 1, ControllerRole::endpoint, 1, star}), Catch::Contains("fall apart"));
  const Graph g = test::graph(2, 2, {{0, 1}, {0, 2}, {1, 2}}, ControllerRole::endpoint);
  CHECK(g.vertices() == 3);
  CHECK(g.controller() == 2);
  CHECK(g.controller_links() == 2);
  CHECK_FALSE(g.forwards(2));
  CHECK(g.forwards(0));
  CHECK(g.among_workers().arcs() == 2);
}

TEST_CASE("links rotate around the workers while the controller stays", "[topology]") {
  CHECK(turned(6, 3, std::vector<GraphLink>{{0, 1}}) ==
        std::vector<GraphLink>{{0, 1}, {2, 3}, {4, 5}});
  CHECK(turned(4, 2, std::vector<GraphLink>{{0, 2}, {1, 4}}) ==
        std::vector<GraphLink>{{0, 2}, {1, 4}, {3, 4}});
  const GraphPlan plan{4, 3, ControllerRole::endpoint, 2,
                       turned(4, 2, std::vector<GraphLink>{{0, 1}, {1, 2}, {0, 4}})};
  CHECK(Graph(plan).rotation() == 2);
}

TEST_CASE("the hash depends on the graph and not on the order of its links", "[topology]") {
  const Graph g = test::graph(3, 2, triangle);
  CHECK(g.hash() == test::graph(3, 2, {{2, 0}, {2, 1}, {1, 0}}).hash());
  CHECK(g.hash() != test::graph(3, 2, {{0, 1}, {1, 2}}).hash());
  CHECK(g.hash() != test::graph(3, 3, triangle).hash());
  const std::vector<GraphLink> three{{0, 1}, {0, 2}, {1, 2}};
  CHECK(test::graph(2, 2, three, ControllerRole::endpoint).hash() !=
        test::graph(2, 2, three, ControllerRole::forwards).hash());
}
