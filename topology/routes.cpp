// All routes to one destination form a tree. A vertex with several neighbours nearer to the
// destination may be attached, with its subtree, to any of them: a move takes its weight (the
// messages that pass it) from the links of one path and adds it to those of the other, up to where
// both meet. A move is accepted if the sum of squared loads does not grow; neutral moves cross
// plateaus. The objective is the sum of squares and not the maximum, since it shows even for moves
// far from the heaviest link whether they help.
#include "topology/routes.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "runtime/core/hash.hpp"
#include "runtime/core/random.hpp"

namespace luxodus {
namespace {

// Most passes over all choices. Twice as many change the heaviest links of graphs of 6 to 1024
// vertices by at most one message.
constexpr uint64_t max_passes = 100;
// Most passes for large graphs: a pass takes time quadratic in the vertices, and the first ten make
// all but a millionth of the gain. With a hundred, 1024 vertices took seconds, and their heaviest
// links were lighter by at most 0.4 %.
constexpr uint64_t min_passes = 10;
constexpr uint64_t fully_searched = 256;  // workers: up to this many all passes are made
// Consecutive passes without gain that end the search.
constexpr int max_idle_passes = 20;

uint64_t passes_for(uint64_t workers) {
  const uint64_t affordable = max_passes * fully_searched * fully_searched / (workers * workers);
  return std::clamp(affordable, min_passes, max_passes);
}

/// A set of a vertex's ports.
using PortSet = uint64_t;
static_assert(limits::vertex_links <= 64, "a port is a bit of a word");

}  // namespace

uint32_t Routes::longest() const {
  return hops_.empty() ? 0 : *std::max_element(hops_.begin(), hops_.end());
}

/// Fills Routes. Used once.
class RouteBalancer {
 public:
  explicit RouteBalancer(const Graph& graph)
      : graph_(graph), random_(0, RandomStream::graph), port_back_(graph.all().arcs()) {
    const Adjacency& all = graph.all();
    const uint32_t n = graph.vertices();
    routes_.vertices_ = n;
    routes_.hops_.assign(size_t{n} * n, unseen);
    routes_.port_.assign(size_t{n} * n, 0);
    weight_.assign(size_t{n} * n, 0);
    load_.assign(all.arcs(), 0);
    for (Vertex v = 0; v < n; ++v) {
      routes_.first_arc_.push_back(all.arc(v, 0));
      for (uint32_t port = 0; port < all.degree(v); ++port) {
        const auto back = all.of(all.of(v)[port]);
        port_back_[all.arc(v, port)] =
            static_cast<uint8_t>(std::lower_bound(back.begin(), back.end(), v) - back.begin());
      }
    }
    for (uint32_t arc = 0; arc < all.arcs(); ++arc) routes_.target_.push_back(all.target(arc));
  }

  Routes run() && {
    Choices among_workers;
    std::vector<PortSet> from_controller;
    for (Vertex to = 0; to < graph_.workers(); ++to) {
      plant_tree(to);
      send_from_all_workers(to);
      for (Vertex from = 0; from < graph_.vertices(); ++from) {
        if (graph_.forwards(from)) among_workers.add(graph_, from, to, nearer_[from]);
      }
      if (graph_.has_controller()) from_controller.push_back(nearer_[graph_.controller()]);
    }
    if (graph_.has_controller()) plant_tree(graph_.controller());
    search(among_workers);
    if (graph_.has_controller()) balance_controller(from_controller);
    seal();
    return std::move(routes_);
  }

 private:
  static constexpr uint16_t unseen = 0xFFFF;

  /// A choice among several arcs that begin a shortest path from `from` to `to`.
  struct Choice {
    Vertex from;
    Vertex to;
    uint32_t first_option;
    uint32_t options;
  };
  struct Choices {
    /// Adds nothing if there is no choice.
    void add(const Graph& graph, Vertex from, Vertex to, PortSet ports) {
      const auto options = static_cast<uint32_t>(std::popcount(ports));
      if (options < 2) return;
      all.push_back({from, to, static_cast<uint32_t>(arcs.size()), options});
      for (; ports != 0; ports &= ports - 1) {
        arcs.push_back(graph.all().arc(from, static_cast<uint32_t>(std::countr_zero(ports))));
      }
    }
    std::vector<Choice> all;
    std::vector<uint32_t> arcs;  // the choices' options in sequence
  };

  /// Computes hops to `to` from everywhere, all nearer neighbours, and the first of these.
  void plant_tree(Vertex to) {
    const Adjacency& all = graph_.all();
    uint16_t* const hops = &routes_.hops_[routes_.at(0, to)];
    hops[to] = 0;
    nearer_.assign(graph_.vertices(), 0);
    queue_.assign(1, to);
    for (size_t i = 0; i < queue_.size(); ++i) {
      const Vertex v = queue_[i];
      if (v != to && !graph_.forwards(v)) continue;
      const auto farther = static_cast<uint16_t>(hops[v] + 1);
      for (uint32_t port = 0; port < all.degree(v); ++port) {
        const Vertex from = all.of(v)[port];
        if (hops[from] == unseen) {
          hops[from] = farther;
          queue_.push_back(from);
        }
        if (hops[from] == farther) nearer_[from] |= PortSet{1} << port_back_[all.arc(v, port)];
      }
    }
    for (size_t i = 1; i < queue_.size(); ++i) {
      const Vertex from = queue_[i];
      routes_.port_[routes_.at(from, to)] = static_cast<uint8_t>(std::countr_zero(nearer_[from]));
    }
  }

  /// A message from each worker: a vertex forwards its own and those of its subtree. The queue of
  /// plant_tree() has the farthest last.
  void send_from_all_workers(Vertex to) {
    for (size_t i = queue_.size() - 1; i > 0; --i) {
      const Vertex from = queue_[i];
      int32_t& weight = weight_[routes_.at(from, to)];
      if (from < graph_.workers()) ++weight;
      load_[routes_.next_arc(from, to)] += weight;
      if (const Vertex next = routes_.next_hop(from, to); next != to)
        weight_[routes_.at(next, to)] += weight;
    }
  }

  /// Only the controller's own first hop is a choice: the rest are the workers' routes.
  void balance_controller(const std::vector<PortSet>& from_controller) {
    std::fill(weight_.begin(), weight_.end(), 0);
    std::fill(load_.begin(), load_.end(), 0);
    const Vertex controller = graph_.controller();
    Choices choices;
    for (Vertex v = 0; v < graph_.workers(); ++v) {
      send(v, controller);
      choices.add(graph_, v, controller, nearer_[v]);
      send(controller, v);
      if (graph_.controller_role() == ControllerRole::endpoint)
        choices.add(graph_, controller, v, from_controller[v]);
    }
    search(choices);
  }

  /// Sends one message along the present routes.
  void send(Vertex from, Vertex to) {
    for (Vertex v = from; v != to; v = routes_.next_hop(v, to)) {
      ++weight_[routes_.at(v, to)];
      ++load_[routes_.next_arc(v, to)];
    }
  }

  void search(const Choices& choices) {
    const uint64_t passes = passes_for(graph_.workers());
    int idle = 0;
    for (uint64_t pass = 0; pass < passes && idle < max_idle_passes; ++pass) {
      random_.start(pass);
      bool gained = false;
      for (const Choice& choice : choices.all) {
        const uint64_t drawn = uint64_t{random_.bits()} * choice.options >> 32;
        gained |= try_arc(choice.from, choice.to, choices.arcs[choice.first_option + drawn]);
      }
      idle = gained ? 0 : idle + 1;
    }
  }

  /// Changes a next hop unless the sum of squares grows. Returns true if it shrinks.
  bool try_arc(Vertex from, Vertex to, uint32_t new_arc) {
    const uint32_t old_arc = routes_.next_arc(from, to);
    if (new_arc == old_arc) return false;
    const int32_t weight = weight_[routes_.at(from, to)];
    const int64_t growth = reroute_growth(old_arc, new_arc, to, weight);
    if (growth > 0) return false;
    carry(old_arc, new_arc, to, weight);
    routes_.port_[routes_.at(from, to)] = static_cast<uint8_t>(new_arc - graph_.all().arc(from, 0));
    return growth < 0;
  }

  /// Calls `both(arc, arc)` for each step of two paths of equal length to `to`, until they meet.
  template <class Both>
  void along(uint32_t a, uint32_t b, Vertex to, Both both) const {
    while (true) {
      both(a, b);
      const Vertex from_a = graph_.all().target(a);
      const Vertex from_b = graph_.all().target(b);
      if (from_a == from_b) return;
      a = routes_.next_arc(from_a, to);
      b = routes_.next_arc(from_b, to);
    }
  }

  /// Growth of the sum of squares: (load + w)^2 - load^2, and the same with -w.
  int64_t reroute_growth(uint32_t old_arc, uint32_t new_arc, Vertex to, int64_t weight) const {
    int64_t growth = 0;
    along(old_arc, new_arc, to, [&](uint32_t from, uint32_t onto) {
      growth += 2 * weight * (load_[onto] - load_[from] + weight);
    });
    return growth;
  }

  void carry(uint32_t old_arc, uint32_t new_arc, Vertex to, int32_t weight) {
    along(old_arc, new_arc, to, [&](uint32_t from, uint32_t onto) {
      load_[from] -= weight;
      load_[onto] += weight;
      const Vertex left = graph_.all().target(from);
      const Vertex entered = graph_.all().target(onto);
      if (left == entered) return;
      weight_[routes_.at(left, to)] -= weight;
      weight_[routes_.at(entered, to)] += weight;
    });
  }

  void seal() {
    Hasher hasher;
    hasher.add(graph_.hash());
    hasher.add(routes_.hops_.data(), routes_.hops_.size() * sizeof(uint16_t));
    hasher.add(routes_.port_.data(), routes_.port_.size());
    routes_.hash_ = hasher.value();
  }

  const Graph& graph_;
  Random random_;
  Routes routes_;
  std::vector<uint8_t> port_back_;  // by arc: its port at its target
  // ports that begin a shortest path in the last planted tree: [from]
  std::vector<PortSet> nearer_;
  std::vector<Vertex> queue_;    // of plant_tree()
  std::vector<int32_t> weight_;  // messages that pass a vertex on the way to another: [to][from]
  std::vector<int64_t> load_;    // by arc
};

Routes balanced_routes(const Graph& graph) {
  return RouteBalancer(graph).run();
}

namespace {

/// Sends a message from each worker to each destination, and returns the load of each arc.
std::vector<uint64_t> carried(const Graph& graph, const Routes& routes, Vertex first_destination,
                              Vertex end_destination) {
  std::vector<uint64_t> load(graph.all().arcs());
  for (Vertex to = first_destination; to < end_destination; ++to) {
    for (Vertex from = 0; from < graph.workers(); ++from) {
      for (Vertex v = from; v != to; v = routes.next_hop(v, to)) ++load[routes.next_arc(v, to)];
    }
  }
  return load;
}

LinkLoads summed_up(const std::vector<uint64_t>& loads) {
  if (loads.empty()) return {};
  const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
  const uint64_t sum = std::accumulate(loads.begin(), loads.end(), uint64_t{0});
  return {*most, *least, (sum + loads.size() - 1) / loads.size()};
}

}  // namespace

LinkLoads all_to_all_loads(const Graph& graph, const Routes& routes) {
  const std::vector<uint64_t> load = carried(graph, routes, 0, graph.workers());
  std::vector<uint64_t> counted;
  for (Vertex v = 0; v < graph.vertices(); ++v) {
    for (uint32_t port = 0; port < graph.all().degree(v); ++port) {
      if (graph.forwards(v) && graph.forwards(graph.all().of(v)[port])) {
        counted.push_back(load[graph.all().arc(v, port)]);
      }
    }
  }
  return summed_up(counted);
}

LinkLoads gather_loads(const Graph& graph, const Routes& routes) {
  const Vertex controller = graph.controller();
  const std::vector<uint64_t> load = carried(graph, routes, controller, controller + 1);
  std::vector<uint64_t> counted;
  for (uint32_t arc = 0; arc < graph.all().arcs(); ++arc) {
    if (graph.all().target(arc) == controller) counted.push_back(load[arc]);
  }
  return summed_up(counted);
}

}  // namespace luxodus
