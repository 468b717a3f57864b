#include "topology/structure.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/topology/graph_tools.hpp"
#include "topology/builders.hpp"

using namespace luxodus;

namespace {

struct Structure {
  uint32_t edges, vertices;
  std::optional<uint32_t> girth;
  uint32_t bisection;

  friend bool operator==(const Structure&, const Structure&) = default;
};

Structure structure(const Graph& graph) {
  return {edge_connectivity(graph.all()), vertex_connectivity(graph.all()), girth(graph.all()),
          bisection_upper_bound(graph.all())};
}

}  // namespace

TEST_CASE("known graphs have their known connectivity, girth and bisection", "[topology]") {
  CHECK(structure(make_ring(9).value()) == Structure{2, 2, 9, 2});
  CHECK(structure(make_ring(2).value()) == Structure{1, 1, std::nullopt, 1});
  CHECK(structure(make_ring(1).value()) == Structure{0, 0, std::nullopt, 0});
  CHECK(structure(make_random_regular(6, 5, 0).value()) == Structure{5, 5, 3, 9});
  CHECK(structure(make_hypercube(16).value()) == Structure{4, 4, 4, 8});
  CHECK(structure(make_mesh(16).value()) == Structure{2, 2, 4, 4});
  CHECK(structure(make_torus(16).value()) == Structure{4, 4, 4, 8});
  CHECK(edge_connectivity(make_ternary_tree(20)->all()) == 1);
  CHECK(girth(make_ternary_tree(20)->all()) == std::nullopt);
}

TEST_CASE("the Petersen graph has connectivity 3 and girth 5", "[topology]") {
  std::vector<GraphLink> links;
  for (Vertex v = 0; v < 5; ++v) {
    links.push_back({v, (v + 1) % 5});
    links.push_back({v, v + 5});
    links.push_back({v + 5, (v + 2) % 5 + 5});
  }
  const Graph petersen = test::graph(10, 3, links);
  CHECK(structure(petersen) == Structure{3, 3, 5, 5});
}

TEST_CASE("two dense parts joined at one vertex are disconnected without it", "[topology]") {
  // Triangles 0 1 2 and 2 3 4: two links must fail, or one vertex.
  const Graph bow = test::graph(5, 4, {{0, 1}, {1, 2}, {0, 2}, {2, 3}, {3, 4}, {2, 4}});
  CHECK(edge_connectivity(bow.all()) == 2);
  CHECK(vertex_connectivity(bow.all()) == 1);
}
