#include <fmt/core.h>

#include <functional>
#include <string>

#include "actors/cast/node/graph_routes.hpp"
#include "runtime/net/link_view.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"
#include "topology/builders.hpp"
#include "topology/shipped.hpp"

namespace luxodus::bench {

namespace {

/// Median CPU seconds of `piece`, which is repeated `inside` times per measurement.
double median_seconds(int repeats, int inside, const std::function<void()>& piece) {
  std::vector<double> seconds;
  for (int r = 0; r < repeats; ++r) {
    const double start = thread_seconds();
    for (int i = 0; i < inside; ++i) piece();
    seconds.push_back((thread_seconds() - start) / inside);
  }
  return summarise(seconds).median;
}

/// Work of one node at each link change: it updates its view, lists the links that are down, and
/// recomputes its next hops.
class RouteUpdater {
 public:
  RouteUpdater(const Graph& graph, const Routes& balanced)
      : edges_(edges_of(graph)), view_(edges_), routes_(graph, balanced, 0) {}

  /// Takes this many links down, evenly spread.
  void fail(size_t links) {
    for (size_t i = 0; i < links; ++i) view_.set(edges_[i * edges_.size() / links], false);
  }
  void change_a_link() {
    up_ = !up_;
    view_.set(edges_[edges_.size() / 2], up_);
    failed_.clear();
    for (const Edge& edge : view_.down()) failed_.push_back({edge.a.value, edge.b.value});
    reached_ = 0;
    for (const auto& next : routes_.around(failed_)) reached_ += next.has_value() ? 1u : 0u;
  }
  size_t reached() const { return reached_; }

 private:
  std::vector<Edge> edges_;
  LinkView view_;
  NodeRoutes routes_;
  std::vector<GraphLink> failed_;
  bool up_ = true;
  size_t reached_ = 0;
};

void print_graph(int repeats, const std::string& name, const Graph& graph) {
  constexpr int reroutes = 200;
  const Routes balanced = balanced_routes(graph);
  const double whole = median_seconds(repeats, 1, [&] { balanced_routes(graph); });
  RouteUpdater one(graph, balanced), many(graph, balanced);
  many.fail(graph.links().size() / 20);
  const double around_one = median_seconds(repeats, reroutes, [&] { one.change_a_link(); });
  const double around_many = median_seconds(repeats, reroutes, [&] { many.change_a_link(); });
  const LinkLoads loads = all_to_all_loads(graph, balanced);
  fmt::print("{:<32} {:>10.2f} {:>10.4f} {:>10.4f} {:>9} {:>9} {:>9}\n", name, 1e3 * whole,
             1e3 * around_one, 1e3 * around_many, many.reached(), loads.heaviest, loads.bound);
}

}  // namespace

void print_routes(int repeats) {
  fmt::print("\nRoutes, 4 links a node [ms of processor time]\n{:<32} {:>10} {:>10} {:>10} {:>9} ",
             "graph", "balanced", "reroute", "5 % down", "reached");
  fmt::print("{:>9} {:>9}\n", "heaviest", "bound");
  for (const uint32_t nodes : {64u, 256u})
    print_graph(repeats, fmt::format("minimum path, {}", nodes), *shipped_graph({nodes, 4, 0}));
  print_graph(repeats, "random regular, 1024", make_random_regular(1024, 4, 1).value());
}

}  // namespace luxodus::bench
