#include "topology/lift.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/topology/graph_tools.hpp"

using namespace luxodus;

namespace {

const std::vector<LiftShape> shapes{{8, 4, 4, 4},  {8, 4, 4, 0},  {16, 1, 3, 0},  {13, 1, 3, 2},
                                    {7, 3, 3, 3},  {5, 7, 4, 0},  {9, 8, 4, 0},   {70, 1, 4, 0},
                                    {64, 2, 3, 2}, {8, 32, 4, 0}, {12, 10, 4, 0}, {1, 13, 4, 0}};

/// The graph of a lift, if it is valid.
std::optional<Graph> graph_of(const Lift& lift) {
  const LiftShape& shape = lift.shape();
  const GraphPlan plan{shape.workers(), shape.links,
                       shape.controller_links > 0 ? ControllerRole::endpoint : ControllerRole::none,
                       shape.turns, lift.links()};
  if (fault_of(plan)) return std::nullopt;
  return Graph(plan);
}

}  // namespace

TEST_CASE("a lift of any shape stays within its links and keeps its rotation through all changes",
          "[topology][lift]") {
  Random random(3, RandomStream::test);
  for (size_t s = 0; s < shapes.size(); ++s) {
    random.start(s);
    Lift lift(shapes[s], random);
    for (int i = 0; i < 200; ++i) {
      lift.change(random);
      const std::vector<GraphLink> links = lift.links();
      REQUIRE(turned(shapes[s].workers(), shapes[s].turns, links) == links);
      std::vector<uint32_t> degree(shapes[s].workers() + 1);
      for (const GraphLink& link : links) {
        ++degree[link.a];
        ++degree[link.b];
      }
      for (Vertex v = 0; v < shapes[s].workers(); ++v) REQUIRE(degree[v] <= shapes[s].links);
      REQUIRE(degree.back() <= shapes[s].controller_links);
    }
  }
}

TEST_CASE("an undone change leaves no trace", "[topology][lift]") {
  Random random(4, RandomStream::test);
  random.start(0);
  for (const LiftShape& shape : shapes) {
    Lift lift(shape, random);
    for (int i = 0; i < 100; ++i) {
      const std::vector<GraphLink> before = lift.links();
      lift.change(random);
      lift.take_back();
      REQUIRE(lift.links() == before);
      lift.change(random);
    }
  }
}

TEST_CASE("hops of a lift equal those of its graph", "[topology][lift]") {
  Random random(5, RandomStream::test);
  random.start(0);
  int compared = 0;
  for (const LiftShape& shape : shapes) {
    const auto counter = make_hop_counter(shape);
    Lift lift(shape, random);
    for (int i = 0; i < 20; ++i) {
      lift.change(random);
      const auto graph = graph_of(lift);
      if (!graph) continue;
      uint64_t hops = 0;
      for (Vertex from = 0; from < graph->vertices(); ++from) {
        for (const int h : test::hops_from(*graph, from)) hops += static_cast<uint64_t>(h);
      }
      REQUIRE(counter->hops(lift, UINT64_MAX) * shape.turns == hops);
      ++compared;
    }
  }
  CHECK(compared > 100);
}

TEST_CASE("a count that is cut short exceeds the limit", "[topology][lift]") {
  Random random(6, RandomStream::test);
  random.start(0);
  const LiftShape shape{8, 4, 4, 0};
  const auto counter = make_hop_counter(shape);
  for (int i = 0; i < 100; ++i) {
    const Lift lift(shape, random);
    const uint64_t hops = counter->hops(lift, UINT64_MAX);
    for (const uint64_t enough : {uint64_t{0}, hops / 2, hops - 1}) {
      REQUIRE(counter->hops(lift, enough) > enough);
    }
    REQUIRE(counter->hops(lift, hops) == hops);
  }
}
