#include "topology/amp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "topology/distances.hpp"
#include "topology/lift.hpp"
#include "topology/measure.hpp"
#include "topology/routes.hpp"

namespace luxodus {
namespace {

// Base vertices of a rotational search: more symmetry forces short cycles; less takes longer and
// may miss the optimum (40 nodes meet the bound at once with 8 or 10, but not within 8 s with 40).
constexpr uint32_t min_base = 8;
constexpr uint32_t max_base = 16;
// Up to this many nodes every rotation is tried: runs are short.
constexpr uint32_t small_nodes = 16;

// Temperatures [hops of the base vertices]. Of 100 runs with 128 nodes, those from 3 to 0.8 found
// the shortest graph 4 times, from 1.5 to 0.8 three times, from 3 to 1.2 once.
constexpr double hottest = 3.0;
constexpr double coldest = 0.8;

// Number of graphs at the bound that are compared. With 32 nodes, 47 of 52 searches found among
// them one with balanced routes whose diameter is 4 after any failure, the minimum.
constexpr uint32_t compared_at_bound = 24;

constexpr uint64_t moves_between_questions = 4096;

Result<void> check_request(const AmpRequest& request) {
  const uint64_t nodes = request.nodes;
  const uint64_t links = request.links;
  const uint64_t controller = request.controller_links;
  if (nodes == 0) return problem("a graph has at least one node; ask for --nodes 1 or more");
  if (nodes + (controller > 0 ? 1 : 0) > limits::graph_vertices)
    return problem(fmt::format("{} nodes are more than {}, controller included", nodes,
                               limits::graph_vertices));
  if (links > limits::vertex_links || controller > limits::vertex_links)
    return problem(fmt::format("a vertex has at most {} links", limits::vertex_links));
  if (controller > nodes)
    return problem(fmt::format("a controller with {} links needs as many nodes", controller));
  // A node has n - 1 partners among the nodes; only the controller can use further links.
  const uint64_t ends = nodes * std::min(links, nodes - 1 + (controller > 0 ? 1 : 0));
  const uint64_t needed = 2 * (nodes - 1) + controller;
  if (ends < needed)
    return problem(fmt::format(
        "{} nodes with {} links each have {} ends of links, and {} are needed to connect all{}; "
        "give each node more links",
        nodes, links, ends, needed, controller > 0 ? " without the controller's help" : ""));
  return {};
}

/// Decompositions of the nodes into rotated copies of base vertices; runs take them in turn.
std::vector<LiftShape> shapes_for(const AmpRequest& request) {
  std::vector<LiftShape> shapes, larger;
  for (uint32_t turns = request.nodes; turns >= 1; --turns) {
    if (request.nodes % turns != 0 || request.controller_links % turns != 0) continue;
    const LiftShape shape{request.nodes / turns, turns, request.links, request.controller_links};
    const bool fits = shape.base >= min_base && shape.base <= max_base;
    if (fits || request.nodes <= small_nodes) shapes.push_back(shape);
    if (shape.base > max_base) larger.push_back(shape);
  }
  if (shapes.empty()) shapes.push_back(larger.front());
  return shapes;
}

/// Lower bound on the hops of all ordered pairs of any lift, in HopCounter's units times turns.
uint64_t bound_of(const AmpRequest& request) {
  uint64_t hops =
      hop_bound(full_worker_degrees(request.nodes, request.links, request.controller_links)).hops;
  if (request.controller_links > 0)
    hops += 2 * controller_bound(request.nodes, request.links, request.controller_links).hops;
  return hops;
}

/// Useful number of runs and of moves per run for a size: enough to find the graphs of the README.
struct Effort {
  uint64_t runs;
  uint64_t moves;
};

/// `costliest` is the shape with the largest base.
Effort effort_for(const LiftShape& costliest) {
  const uint32_t nodes = costliest.workers();
  if (nodes <= small_nodes) return {24, 20'000};
  if (nodes <= 40) return {24, 100'000};
  // Each joint is read once per hop for each 64 sources. This many reads take half a minute to two,
  // longer for larger bases; a size without a useful rotation, such as a large prime, gets fewer
  // moves.
  constexpr uint64_t max_reads = 5'000'000'000;
  constexpr uint64_t min_runs = 8;
  const uint64_t reads = uint64_t{costliest.base} * costliest.links * (costliest.base / 64 + 1);
  const uint64_t all_moves = max_reads / reads;
  const uint64_t moves = std::min<uint64_t>(500'000, all_moves / min_runs);
  return {std::min<uint64_t>(80, all_moves / moves), moves};
}

/// A graph that was found, with its criteria of comparison.
class Candidate {
 public:
  explicit Candidate(Graph graph) : graph_(std::move(graph)) {
    const PathLengths workers = path_lengths(graph_.among_workers());
    diameter_ = workers.diameter;
    hops_ = workers.hops;
    if (!graph_.has_controller()) return;
    const PathLengths all = path_lengths(graph_.all());
    diameter_ = std::max(diameter_, all.diameter);
    hops_ += all.hops;
  }

  const Graph& graph() const { return graph_; }

  bool better_than(Candidate& other) {
    const auto length = std::tuple(diameter_, hops_);
    const auto length_of_other = std::tuple(other.diameter_, other.hops_);
    if (length != length_of_other) return length < length_of_other;
    return sturdiness() < other.sturdiness();
  }

 private:
  /// Heaviest link; diameter and average after the worst failure; distance from the most symmetric
  /// graph. Less is better.
  using Sturdiness = std::tuple<uint64_t, uint32_t, double, uint32_t>;

  const Sturdiness& sturdiness() {
    if (sturdiness_) return *sturdiness_;
    const Adjacency workers = graph_.among_workers();
    const FailureHarm link = harm_of_any_link(workers);
    const FailureHarm vertex = harm_of_any_vertex(workers);
    sturdiness_ = {all_to_all_loads(graph_, balanced_routes(graph_)).heaviest,
                   std::max(link.diameter, vertex.diameter), std::max(link.average, vertex.average),
                   graph_.workers() - graph_.rotation()};
    return *sturdiness_;
  }

  Graph graph_;
  uint32_t diameter_ = 0;
  uint64_t hops_ = 0;
  // expensive, so computed at most once and only if it decides
  std::optional<Sturdiness> sturdiness_;
};

class AmpSearch {
 public:
  AmpSearch(const AmpRequest& request, const std::function<bool()>& stop)
      : request_(request), stop_(stop), bound_(bound_of(request)) {}

  /// Nothing if stopped before anything was found.
  std::optional<Graph> run() {
    const std::vector<LiftShape> shapes = shapes_for(request_);
    const Effort effort = effort_for(shapes.back());  // the bases grow
    const uint64_t max_runs = request_.runs > 0 ? request_.runs : effort.runs;
    for (; runs_ < max_runs && at_bound_ < compared_at_bound && !stopped_; ++runs_) {
      anneal(shapes[runs_ % shapes.size()], effort.moves);
    }
    if (!best_) return std::nullopt;
    return best_->graph();
  }

  uint32_t runs() const { return runs_; }
  uint64_t moves() const { return moves_; }

 private:
  void anneal(const LiftShape& shape, uint64_t moves) {
    Random random(request_.seed, RandomStream::graph);
    random.start(runs_);
    const auto counter = make_hop_counter(shape);
    Lift lift(shape, random);
    uint64_t hops = counter->hops(lift, UINT64_MAX);
    Lift shortest = lift;
    uint64_t fewest = hops;
    const double cooling = std::log(coldest / hottest);
    double temperature = hottest;
    for (uint64_t move = 0; move < moves && fewest * shape.turns > bound_; ++move, ++moves_) {
      if (move % moves_between_questions == 0) {
        stopped_ = stop_();
        if (stopped_) break;
        temperature =
            hottest * std::exp(cooling * static_cast<double>(move) / static_cast<double>(moves));
      }
      // Metropolis criterion: `more` additional hops are accepted with probability exp(-more /
      // temperature).
      const double more = -temperature * std::log(1.0 - random.uniform_double());
      const uint64_t enough = hops + static_cast<uint64_t>(more);
      lift.change(random);
      const uint64_t changed = counter->hops(lift, enough);
      if (changed > enough) {
        lift.take_back();
        continue;
      }
      hops = changed;
      if (hops < fewest) {
        fewest = hops;
        shortest = lift;
      }
    }
    if (fewest * shape.turns <= bound_) ++at_bound_;
    consider(shape.turns, shortest.links());
  }

  void consider(uint32_t turns, std::vector<GraphLink> links) {
    const ControllerRole role =
        request_.controller_links > 0 ? ControllerRole::endpoint : ControllerRole::none;
    GraphPlan plan{request_.nodes, request_.links, role, turns, std::move(links)};
    if (fault_of(plan)) return;  // not connected
    Candidate candidate{Graph(std::move(plan))};
    if (!best_ || candidate.better_than(*best_)) best_ = std::move(candidate);
  }

  const AmpRequest& request_;
  const std::function<bool()>& stop_;
  const uint64_t bound_;
  std::optional<Candidate> best_;
  bool stopped_ = false;
  uint32_t runs_ = 0;
  uint32_t at_bound_ = 0;
  uint64_t moves_ = 0;
};

/// The complete graph, with the controller linked to the first nodes, if there are enough links.
std::optional<Graph> complete_graph(const AmpRequest& request) {
  const bool controller = request.controller_links > 0;
  if (request.links + 1 < request.nodes + (controller ? 1 : 0)) return std::nullopt;
  GraphPlan plan{request.nodes, request.links, ControllerRole::none, request.nodes, {}};
  for (Vertex b = 1; b < request.nodes; ++b) {
    for (Vertex a = 0; a < b; ++a) plan.links.push_back({a, b});
  }
  if (controller) {
    plan.controller = ControllerRole::endpoint;
    plan.rotation =
        std::gcd(request.nodes, request.controller_links) == request.nodes ? request.nodes : 1;
    for (Vertex v = 0; v < request.controller_links; ++v) plan.links.push_back({v, request.nodes});
  }
  return Graph(std::move(plan));
}

Graph with_role(const Graph& graph, ControllerRole role) {
  return Graph({graph.workers(), graph.max_links(), role, graph.rotation(), graph.links()});
}

}  // namespace

Result<AmpFound> find_amp(const AmpRequest& request, const std::function<bool()>& stop) {
  if (auto ok = check_request(request); !ok) return ok.problem();
  std::optional<Graph> found = complete_graph(request);
  AmpSearch search(request, stop);
  if (!found) found = search.run();
  if (!found) return problem("no graph was found in this time; give it more, or more links");
  if (found->has_controller() && request.controller_forwards)
    found = with_role(*found, ControllerRole::forwards);
  return AmpFound{std::move(*found), search.runs(), search.moves()};
}

}  // namespace luxodus
