#include "topology/measure.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/topology/graph_tools.hpp"
#include "topology/builders.hpp"
#include "topology/shipped.hpp"

using namespace luxodus;

TEST_CASE("a ring becomes a path when a link or a vertex fails, and a path is disconnected",
          "[topology][measure]") {
  const Graph ring = make_ring(8).value();
  const FailureHarm link = harm_of_any_link(ring.all());
  CHECK_FALSE(link.falls_apart);
  CHECK(link.diameter == 7);
  CHECK(link.average == Approx(3.0));  // of a path of n: (n + 1) / 3
  const FailureHarm vertex = harm_of_any_vertex(ring.all());
  CHECK(vertex.diameter == 6);
  CHECK(vertex.average == Approx(8.0 / 3));
  const Graph path = make_mesh(5).value();
  CHECK(harm_of_any_link(path.all()).falls_apart);
  CHECK(harm_of_any_vertex(path.all()).falls_apart);
  CHECK_FALSE(harm_of_any_vertex(make_ring(2)->all()).falls_apart);
  CHECK_FALSE(harm_of_any_vertex(make_ring(1)->all()).falls_apart);
}

TEST_CASE("harm is the worst case over all links and vertices", "[topology][measure]") {
  const Graph graph = *shipped_graph({32, 4, 0});
  uint32_t diameter = 0;
  double average = 0;
  for (const GraphLink& failed : graph.links()) {
    std::vector<GraphLink> left = graph.links();
    std::erase(left, failed);
    const PathLengths paths = test::plain_path_lengths(test::graph(32, 4, left));
    diameter = std::max(diameter, paths.diameter);
    average = std::max(average, paths.average());
  }
  CHECK(harm_of_any_link(graph.all()).diameter == diameter);
  CHECK(harm_of_any_link(graph.all()).average == average);
}

TEST_CASE(
    "there are as many buffer classes as the longest route has hops, and one spare after a failure",
    "[topology][measure]") {
  const Measures m = measure(*shipped_graph({32, 4, 0}));
  CHECK(m.hop_classes == 3);
  CHECK(m.hop_classes_after_failure == 5);
}

TEST_CASE("nodes are measured without the controller, and the controller by its paths to them",
          "[topology][measure]") {
  // A path of 4 with a controller at its ends: it closes a ring only if it forwards.
  const std::vector<GraphLink> links{{0, 1}, {1, 2}, {2, 3}, {0, 4}, {3, 4}};
  const Measures m = measure(test::graph(4, 2, links, ControllerRole::endpoint));
  CHECK(m.all.paths.diameter == 2);
  CHECK(m.workers->paths.diameter == 3);
  CHECK(m.from_controller->hops == 1 + 2 + 2 + 1);
  CHECK(m.gather->heaviest == 2);
  CHECK(m.hop_classes == 3);
  CHECK(measure(test::graph(4, 2, links, ControllerRole::forwards)).hop_classes == 2);
}

TEST_CASE("one vertex and two are measured", "[topology][measure]") {
  const Measures one = measure(make_ring(1).value());
  CHECK(one.all.paths.pairs == 0);
  CHECK(one.hop_classes == 0);
  CHECK(one.all_to_all.heaviest == 0);
  const Measures two = measure(make_ring(2).value());
  CHECK(two.all.paths.average() == 1);
  CHECK(two.all.any_link.falls_apart);
  CHECK(two.all_to_all.heaviest == 1);
}
