// The tree of coordinators: every worker once, at most the fan-out each, close together.
#include "topology/coordination_tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "topology/routes.hpp"

using namespace luxodus;

namespace {

/// A ring with chords, and a controller with up to four links to it.
Graph graph_of(uint32_t workers) {
  GraphPlan plan;
  plan.workers = workers;
  plan.max_links = 6;
  plan.controller = ControllerRole::endpoint;
  std::set<GraphLink> links;
  for (Vertex v = 0; v < workers; ++v)
    for (const uint32_t step : {1u, 7u})
      if (const Vertex to = (v + step) % workers; to != v) links.insert(link_between(v, to));
  for (uint32_t i = 0; i < std::min(workers, 4u); ++i)
    links.insert({i * workers / std::min(workers, 4u), workers});
  plan.links.assign(links.begin(), links.end());
  return Graph(plan);
}

/// Every worker is below the root; each coordinator leads 1 to `fan_out`, and is higher than they.
void check_tree(const Graph& graph, uint32_t fan_out) {
  INFO(graph.workers() << " workers, fan-out " << fan_out);
  const CoordinationTree tree(graph, fan_out);
  uint32_t led = 0, tracers = 0;
  for (Vertex v = 0; v <= tree.root(); ++v) {
    const std::vector<Vertex> children = tree.children(v);
    led += static_cast<uint32_t>(children.size());
    CHECK(children.size() <= fan_out);
    CHECK(tree.coordinates(v) == !children.empty());
    if (children.empty()) ++tracers;
    uint32_t below = 0;
    for (const Vertex child : children) {
      CHECK(tree.parent(child) == v);
      CHECK(tree.height(child) < tree.height(v));
      below += tree.tracers(child);
    }
    CHECK(tree.tracers(v) == (children.empty() ? 1 : below));
  }
  CHECK(led == graph.workers());
  CHECK(tree.tracers(tree.root()) == tracers);
}

}  // namespace

TEST_CASE("a tree of coordinators has every worker once, and never exceeds the fan-out",
          "[topology][coordination]") {
  for (const uint32_t nodes : {1u, 2u, 3u, 4u, 5u, 13u, 40u, 64u, 100u})
    for (const uint32_t fan_out : {2u, 3u, 8u, 63u}) check_tree(graph_of(nodes), fan_out);
}

TEST_CASE("below 64 workers there is one level, and from there the fan-out is the square root",
          "[topology][coordination]") {
  const Graph few = graph_of(63);
  const CoordinationTree flat(few, usual_fan_out(63));
  CHECK_FALSE(flat.has_levels());
  CHECK(flat.children(flat.root()).size() == 63);
  CHECK(flat.tracers(flat.root()) == 63);

  const Graph many = graph_of(64);
  const CoordinationTree two(many, usual_fan_out(64));
  CHECK(two.height(two.root()) == 2);
  const std::vector<Vertex> leaders = two.children(two.root());
  CHECK(leaders.size() == 8);
  CHECK(two.tracers(two.root()) == 56);
  for (const Vertex leader : leaders) CHECK(two.children(leader).size() == 7);
}

TEST_CASE("with a small fan-out there are three levels", "[topology][coordination]") {
  const Graph graph = graph_of(40);
  const CoordinationTree tree(graph, 3);
  CHECK(tree.height(tree.root()) == 4);
  const CoordinationTree again(graph, 3);
  for (Vertex v = 0; v < graph.workers(); ++v) CHECK(tree.parent(v) == again.parent(v));
}

TEST_CASE("coordinators are nearer to those whom they lead than others are on average",
          "[topology][coordination]") {
  const Graph graph = graph_of(100);
  const Routes routes = balanced_routes(graph);
  const CoordinationTree tree(graph, usual_fan_out(100));
  double own = 0, any = 0, tracing = 0;
  for (Vertex v = 0; v < graph.workers(); ++v) {
    if (tree.coordinates(v)) continue;
    const std::vector<Vertex> all = tree.children(tree.root());
    double sum = 0;
    for (const Vertex leader : all) sum += routes.hops(v, leader);
    any += sum / static_cast<double>(all.size());
    own += routes.hops(v, tree.parent(v));
    ++tracing;
  }
  CHECK(own / tracing < 0.75 * any / tracing);
}

TEST_CASE("a worker without coordinator knows the next ones, higher than itself, the root last",
          "[topology][coordination]") {
  const Graph graph = graph_of(40);
  const CoordinationTree tree(graph, 3);
  for (Vertex v = 0; v < graph.workers(); ++v) {
    const std::vector<Vertex> coordinators = tree.coordinators_of(v);
    CHECK(coordinators.front() == tree.parent(v));
    CHECK(coordinators.back() == tree.root());
    CHECK(std::set<Vertex>(coordinators.begin(), coordinators.end()).size() == coordinators.size());
    for (const Vertex c : coordinators) CHECK(tree.height(c) > tree.height(v));
    if (tree.parent(v) == tree.root()) CHECK(coordinators.size() == 1);
  }
}
