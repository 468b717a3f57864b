#include "topology/draw.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "topology/builders.hpp"
#include "topology/layout.hpp"
#include "topology/shipped.hpp"

using namespace luxodus;

namespace {

double apart(const DrawnPlace& a, const DrawnPlace& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

size_t count(const std::string& text, const std::string& piece) {
  size_t found = 0;
  for (size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1))
    ++found;
  return found;
}

}  // namespace

TEST_CASE("vertices are drawn in the disc, without overlap", "[topology][draw]") {
  for (const Graph& graph :
       {make_mesh(40).value(), make_ternary_tree(40).value(), make_hypercube(16).value(),
        *shipped_graph({32, 4, 4}), *shipped_graph({16, 4, 0}), make_ring(2).value()}) {
    const std::vector<DrawnPlace> places = layout(graph);
    REQUIRE(places.size() == graph.vertices());
    for (size_t i = 0; i < places.size(); ++i) {
      CHECK(std::hypot(places[i].x, places[i].y) < 1.0001);
      for (size_t j = 0; j < i; ++j) CHECK(apart(places[i], places[j]) > 0.02);
    }
  }
  CHECK(layout(make_ring(1).value()).size() == 1);
}

TEST_CASE("a rotation of the graph is a rotation of its drawing", "[topology][draw]") {
  const Graph graph = *shipped_graph({32, 4, 4});
  REQUIRE(graph.rotation() == 4);
  const std::vector<DrawnPlace> places = layout(graph);
  for (Vertex v = 0; v < 32; ++v) {
    const DrawnPlace turned = places[(v + 8) % 32];
    CHECK(turned.x == Approx(places[v].y).margin(1e-9));
    CHECK(turned.y == Approx(-places[v].x).margin(1e-9));
  }
  CHECK(apart(places[32], {0, 0}) == 0);
}

TEST_CASE("a ring is drawn as a ring, whatever its numbering", "[topology][draw]") {
  const std::vector<DrawnPlace> places = layout(make_ring(24).value());
  for (Vertex v = 0; v < 24; ++v) {
    CHECK(apart(places[v], places[(v + 1) % 24]) == Approx(2 * std::sin(std::numbers::pi / 24)));
  }
}

TEST_CASE("neighbours in a mesh are drawn closer than its corners", "[topology][draw]") {
  const Graph mesh = make_mesh(36).value();
  const std::vector<DrawnPlace> places = layout(mesh);
  for (const GraphLink& link : mesh.links()) {
    CHECK(apart(places[link.a], places[link.b]) < 0.4 * apart(places[0], places[35]));
  }
}

TEST_CASE("a drawing shows every vertex and every link once, and escapes its title",
          "[topology][draw]") {
  const Graph graph = *shipped_graph({32, 4, 4});
  const std::string svg = graph_svg(graph, "a < \"b\" & c");
  CHECK(count(svg, "<circle") == 33);
  CHECK(count(svg, "<line") == graph.links().size());
  CHECK(svg.find("a &lt; &quot;b&quot; &amp; c") != std::string::npos);
  CHECK(svg == graph_svg(graph, "a < \"b\" & c"));
  const std::string dot = graph_dot(graph, "a \"b\" \\");
  CHECK(count(dot, " -- ") == graph.links().size());
  CHECK(count(dot, "pos=") == 33);
  CHECK(dot.find("\"b\"") == std::string::npos);
}
