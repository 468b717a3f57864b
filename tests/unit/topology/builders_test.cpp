#include "topology/builders.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "topology/distances.hpp"

using namespace luxodus;

TEST_CASE("a builder rejects sizes for which it has no graph", "[topology][builders]") {
  for (const auto& make :
       {make_ring, make_mesh, make_torus, make_hypercube, make_ternary_tree, make_chordal_ring}) {
    CHECK_FALSE(make(0).ok());
    CHECK_FALSE(make(limits::graph_vertices + 1).ok());
  }
  CHECK_FALSE(make_hypercube(12).ok());
  CHECK_FALSE(make_random_regular(5, 3, 0).ok());
  CHECK_FALSE(make_random_regular(4, 4, 0).ok());
  CHECK_FALSE(make_random_regular(4, 1, 0).ok());
}

TEST_CASE("every builder makes graphs of one, two and three nodes", "[topology][builders]") {
  for (const auto& make :
       {make_ring, make_mesh, make_torus, make_ternary_tree, make_chordal_ring}) {
    for (const uint32_t nodes : {1u, 2u, 3u}) {
      const auto graph = make(nodes);
      REQUIRE(graph.ok());
      CHECK(graph->vertices() == nodes);
    }
  }
  CHECK(make_hypercube(1)->vertices() == 1);
  CHECK(make_hypercube(2)->links().size() == 1);
}

TEST_CASE("rotations apply to the vertex numbers", "[topology][builders]") {
  CHECK(make_ring(12)->rotation() == 12);
  CHECK(make_torus(32)->rotation() == 4);
  CHECK(make_hypercube(32)->rotation() == 2);
  CHECK(make_chordal_ring(13)->rotation() == 13);
}

TEST_CASE("a random graph has its links at every node and depends on its seed",
          "[topology][builders]") {
  for (const uint32_t links : {2u, 3u, 4u, 7u}) {
    const auto graph = make_random_regular(40, links, 9);
    REQUIRE(graph.ok());
    for (Vertex v = 0; v < 40; ++v) REQUIRE(graph->all().degree(v) == links);
    CHECK(graph->hash() == make_random_regular(40, links, 9)->hash());
    CHECK(graph->hash() != make_random_regular(40, links, 10)->hash());
  }
}

TEST_CASE("random graphs are about as short as theory predicts", "[topology][builders]") {
  // ln N / ln(d - 1) + 1/2 - (ln d - ln(d - 2) + Euler's constant) / ln(d - 1), for large N.
  const double expected = std::log(1000.0) / std::log(3.0) + 0.5 -
                          (std::log(4.0) - std::log(2.0) + 0.5772) / std::log(3.0);
  const auto graph = make_random_regular(1000, 4, 3);
  CHECK(path_lengths(graph->all()).average() == Approx(expected).epsilon(0.02));
}
