#include "topology/amp.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/topology/graph_tools.hpp"
#include "topology/measure.hpp"

using namespace luxodus;

namespace {

AmpRequest request(uint32_t nodes, uint32_t links, uint32_t controller_links = 0) {
  AmpRequest r;
  r.nodes = nodes;
  r.links = links;
  r.controller_links = controller_links;
  return r;
}

Graph found(const AmpRequest& request) {
  auto result = find_amp(request, test::never_stop);
  INFO(request.nodes << " nodes, " << request.links << " links");
  REQUIRE(result.ok());
  return result->graph;
}

std::string refusal(const AmpRequest& request) {
  const auto result = find_amp(request, test::never_stop);
  return result.ok() ? "" : result.problem().what;
}

}  // namespace

TEST_CASE("a search of 32 nodes and 4 links meets the bound with balanced routes and robust links",
          "[topology][amp]") {
  const Measures m = measure(found(request(32, 4)));
  CHECK(m.all.paths.diameter == 3);
  CHECK(m.all.paths.hops * 31 == m.all.paths.pairs * 73);
  CHECK(m.all_to_all.heaviest == 19);
  CHECK(m.all.any_link.diameter == 4);
  CHECK(m.all.any_vertex.diameter == 4);
}

TEST_CASE(
    "a search with a controller of 4 links meets the bounds of all vertices and of the nodes alone",
    "[topology][amp]") {
  AmpRequest r = request(32, 4, 4);
  r.runs = 6;  // each run meets them; the default compares more
  const Measures m = measure(found(r));
  CHECK(m.all.paths.average() == 2.375);
  CHECK(m.workers->paths.hops == 2368);
  CHECK(m.from_controller->hops == m.from_controller_bound->hops);
}

TEST_CASE("searches of 8, 13 and 40 nodes meet the bound, and of 16 the best known",
          "[topology][amp]") {
  for (const uint32_t nodes : {8u, 13u, 40u}) {
    const Measures m = measure(found(request(nodes, 4)));
    CHECK(m.all.paths.hops == m.all.bound.hops);
    CHECK(m.all.paths.diameter == m.all.bound.diameter);
  }
  CHECK(path_lengths(found(request(16, 4)).all()).average() == 1.75);
}

TEST_CASE("few nodes or many links give the expected graphs", "[topology][amp]") {
  CHECK(found(request(1, 4)).links().empty());
  CHECK(found(request(1, 0)).links().empty());
  CHECK(found(request(2, 4)).links().size() == 1);
  CHECK(found(request(5, 4)).links().size() == 10);
  CHECK(found(request(9, 64)).links().size() == 36);
  CHECK(path_lengths(found(request(11, 2)).all()).diameter == 5);  // a ring
  const Graph lonely = found(request(1, 1, 1));
  CHECK(lonely.vertices() == 2);
  CHECK(lonely.controller_links() == 1);
  CHECK(found(request(4, 4, 4)).links().size() == 6 + 4);
}

TEST_CASE("odd sizes and odd sums of links give connected graphs within their limits",
          "[topology][amp]") {
  for (const auto& [nodes, links, controller] : {std::tuple{7u, 3u, 0u},
                                                 {13u, 3u, 0u},
                                                 {11u, 4u, 1u},
                                                 {12u, 3u, 2u},
                                                 {17u, 5u, 3u},
                                                 {6u, 2u, 1u}}) {
    AmpRequest r = request(nodes, links, controller);
    r.runs = 4;
    const Graph graph = found(r);
    CHECK(graph.workers() == nodes);
    CHECK(graph.controller_links() == controller);
    CHECK(graph.max_links() == links);
  }
  CHECK(path_lengths(found(request(13, 3)).all()).hops == 318);
}

TEST_CASE("a request that no links can connect is rejected with the reason", "[topology][amp]") {
  CHECK_THAT(refusal(request(0, 4)), Catch::Contains("at least one node"));
  CHECK_THAT(refusal(request(3, 1)), Catch::Contains("3 ends of links, and 4 are needed"));
  CHECK_THAT(refusal(request(2, 0)), Catch::Contains("are needed"));
  CHECK_THAT(refusal(request(4, 2, 3)), Catch::Contains("without the controller's help"));
  CHECK_THAT(refusal(request(3, 4, 4)), Catch::Contains("needs as many nodes"));
  CHECK_THAT(refusal(request(1024, 4, 1)), Catch::Contains("more than 1024"));
  CHECK_THAT(refusal(request(100, 65)), Catch::Contains("at most 64"));
}

TEST_CASE("equal requests give equal graphs, other seeds others", "[topology][amp]") {
  AmpRequest r = request(20, 3);
  r.runs = 3;
  CHECK(found(r).hash() == found(r).hash());
  AmpRequest other = r;
  other.seed = 1;
  CHECK(found(r).hash() != found(other).hash());
}

TEST_CASE("a stopped search returns its best graph so far", "[topology][amp]") {
  int questions = 0;
  AmpRequest r = request(64, 4);
  r.runs = UINT32_MAX;
  const auto result = find_amp(r, [&] { return ++questions > 8; });
  REQUIRE(result.ok());
  CHECK(questions == 9);
  CHECK(result->runs == 1);
  CHECK(path_lengths(result->graph.all()).average() < 3.1);
}

TEST_CASE("a controller can be made to forward", "[topology][amp]") {
  AmpRequest r = request(8, 4, 2);
  CHECK_FALSE(found(r).forwards(8));
  r.controller_forwards = true;
  CHECK(found(r).forwards(8));
}
