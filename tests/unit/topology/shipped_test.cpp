#include "topology/shipped.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/topology/graph_tools.hpp"
#include "topology/measure.hpp"
#include "topology/records.hpp"

using namespace luxodus;

namespace {

double average(uint32_t nodes, uint32_t controller_links = 0) {
  return test::plain_path_lengths(
             *shipped_graph({nodes, 4, controller_links}, ControllerRole::forwards))
      .average();
}

}  // namespace

TEST_CASE("every shipped graph is valid, of its size, and within its links",
          "[topology][shipped]") {
  CHECK(shipped_sizes().size() >= 15);
  for (const ShippedSize& size : shipped_sizes()) {
    const auto graph = shipped_graph(size);
    REQUIRE(graph);
    CHECK(graph->workers() == size.nodes);
    CHECK(graph->max_links() == size.links);
    CHECK(graph->controller_links() == size.controller_links);
    CHECK(graph->has_controller() == (size.controller_links > 0));
  }
  CHECK_FALSE(shipped_graph({33, 4, 0}));
}

TEST_CASE("the shipped graphs are as short as promised", "[topology][shipped]") {
  for (const uint32_t nodes : {8u, 13u, 32u, 40u}) {
    const PathLengths paths = test::plain_path_lengths(*shipped_graph({nodes, 4, 0}));
    const PathLengths bound = hop_bound(full_degrees(nodes, 4, 0));
    CHECK(paths.hops == bound.hops);
    CHECK(paths.diameter == bound.diameter);
  }
  CHECK(average(16) == 1.75);
  CHECK(average(32, 4) == 2.375);
  CHECK(path_lengths(shipped_graph({32, 4, 4})->among_workers()).hops == 2368);
  CHECK(average(64) <= 2.8691);
  CHECK(average(128) <= 3.493);
  CHECK(average(256) <= 4.13);
}

TEST_CASE("no shipped graph is disconnected by one link or vertex failure", "[topology][shipped]") {
  for (const ShippedSize& size : shipped_sizes()) {
    const Graph graph = *shipped_graph(size);
    INFO(size.nodes << " nodes");
    CHECK_FALSE(harm_of_any_link(graph.among_workers()).falls_apart);
    CHECK_FALSE(harm_of_any_vertex(graph.among_workers()).falls_apart);
  }
}

TEST_CASE("no best known diameter is below the Moore bound", "[topology][shipped]") {
  int known = 0;
  for (uint32_t nodes = 1; nodes <= limits::graph_vertices; ++nodes) {
    for (uint32_t links = 3; links <= 8; ++links) {
      const auto best = known_best(nodes, links);
      if (!best) continue;
      ++known;
      const PathLengths bound = hop_bound(full_degrees(nodes, links, 0));
      INFO(nodes << " nodes, " << links << " links");
      CHECK(best->average > bound.average() - 1e-6);
      CHECK(best->diameter >= bound.diameter);
      if (best->source == KnownSource::meets_bound) {
        CHECK(best->average == Approx(bound.average()).margin(1e-6));
      }
    }
  }
  CHECK(known > 40);
}
