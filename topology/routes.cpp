// All routes to one destination form a tree. A vertex that has several neighbours nearer to the
// destination may hang, with all that hangs below it, on any of them: a move takes its weight (the
// messages that pass it) from the links of the one way and puts it on those of the other, up to
// where both meet. A move is taken if the sum of squared loads does not grow; moves that change
// nothing lead over plateaus. The sum of squares, not the maximum, is what is followed: it tells
// even of moves far from the heaviest link whether they help.
#include "topology/routes.hpp"

#include <algorithm>
#include <numeric>

#include "runtime/core/hash.hpp"
#include "runtime/core/random.hpp"

namespace luxodus {
namespace {

// Every choice is looked at so often at most. Twice as often changes the heaviest links of graphs
// of 6 to 1024 vertices by one message at most, and a thousand vertices take some seconds then.
constexpr uint64_t max_passes = 100;
// So many passes in a row without gain end the search.
constexpr int max_idle_passes = 20;

}  // namespace

uint32_t Routes::longest() const {
  uint32_t most = 0;
  for (const uint16_t hops : hops_) {
    if (hops != unreachable) most = std::max<uint32_t>(most, hops);
  }
  return most;
}

/// Fills Routes. One use.
class RouteBalancer {
 public:
  RouteBalancer(const Graph& graph, const Failures& failures)
      : graph_(graph),
        vertex_works_(graph.vertices(), true),
        arc_works_(graph.all().arcs(), true),
        random_(0, RandomStream::graph) {
    take_out(failures);
    const uint32_t n = graph.vertices();
    routes_.vertices_ = n;
    routes_.hops_.assign(size_t{n} * n, Routes::unreachable);
    routes_.port_.assign(size_t{n} * n, 0);
    for (Vertex v = 0; v < n; ++v) routes_.first_arc_.push_back(graph.all().arc(v, 0));
    for (uint32_t arc = 0; arc < graph.all().arcs(); ++arc) {
      routes_.target_.push_back(graph.all().target(arc));
    }
  }

  Routes run() && {
    for (Vertex to = 0; to < graph_.vertices(); ++to) {
      if (vertex_works_[to]) plant_tree(to);
    }
    balance_workers();
    if (graph_.has_controller()) balance_controller();
    seal();
    return std::move(routes_);
  }

 private:
  /// A choice among several next hops: of `from`, on the way to `to`.
  struct Choice {
    Vertex from;
    Vertex to;
  };

  void take_out(const Failures& failures) {
    for (const Vertex v : failures.vertices) {
      if (v < graph_.vertices()) vertex_works_[v] = false;
    }
    const Adjacency& all = graph_.all();
    for (Vertex v = 0; v < all.vertices(); ++v) {
      for (uint32_t port = 0; port < all.degree(v); ++port) {
        const Vertex to = all.of(v)[port];
        const auto& broken = failures.links;
        arc_works_[all.arc(v, port)] =
            vertex_works_[v] && vertex_works_[to] &&
            std::find(broken.begin(), broken.end(), link_between(v, to)) == broken.end();
      }
    }
  }

  /// Hops to `to` from everywhere, and of the nearer neighbours the first.
  void plant_tree(Vertex to) {
    const Adjacency& all = graph_.all();
    routes_.hops_[routes_.at(to, to)] = 0;
    std::vector<Vertex> queue{to};
    for (size_t i = 0; i < queue.size(); ++i) {
      const Vertex v = queue[i];
      if (v != to && !graph_.forwards(v)) continue;
      for (uint32_t port = 0; port < all.degree(v); ++port) {
        const Vertex from = all.of(v)[port];
        if (!arc_works_[all.arc(v, port)]) continue;
        if (routes_.hops_[routes_.at(from, to)] != Routes::unreachable) continue;
        routes_.hops_[routes_.at(from, to)] =
            static_cast<uint16_t>(routes_.hops_[routes_.at(v, to)] + 1);
        queue.push_back(from);
      }
    }
    for (size_t i = 1; i < queue.size(); ++i) {
      const Vertex from = queue[i];
      uint32_t port = 0;
      while (!leads_nearer(from, port, to)) ++port;
      routes_.port_[routes_.at(from, to)] = static_cast<uint8_t>(port);
    }
  }

  /// Whether this arc works and is the first of a shortest way.
  bool leads_nearer(Vertex from, uint32_t port, Vertex to) const {
    if (from == to || routes_.hops_[routes_.at(from, to)] == Routes::unreachable) return false;
    const uint32_t arc = graph_.all().arc(from, port);
    const Vertex next = graph_.all().target(arc);
    if (!arc_works_[arc] || (next != to && !graph_.forwards(next))) return false;
    return routes_.hops_[routes_.at(next, to)] + 1 == routes_.hops_[routes_.at(from, to)];
  }

  void balance_workers() {
    start_balance();
    std::vector<Choice> choices;
    for (Vertex to = 0; to < graph_.workers(); ++to) {
      for (Vertex from = 0; from < graph_.workers(); ++from) send(from, to);
      for (Vertex from = 0; from < graph_.vertices(); ++from) {
        if (graph_.forwards(from)) choices.push_back({from, to});
      }
    }
    search(choices);
  }

  /// From the controller only its own first step is left to choose: the rest is the workers' way.
  void balance_controller() {
    start_balance();
    const Vertex controller = graph_.controller();
    std::vector<Choice> choices;
    for (Vertex v = 0; v < graph_.workers(); ++v) {
      send(v, controller);
      choices.push_back({v, controller});
      send(controller, v);
      if (graph_.controller_role() == ControllerRole::endpoint) choices.push_back({controller, v});
    }
    search(choices);
  }

  void start_balance() {
    weight_.assign(routes_.port_.size(), 0);
    load_.assign(graph_.all().arcs(), 0);
  }

  /// One message, along the present routes.
  void send(Vertex from, Vertex to) {
    if (from == to || routes_.hops_[routes_.at(from, to)] == Routes::unreachable) return;
    for (Vertex v = from; v != to; v = graph_.all().target(routes_.next_arc(v, to))) {
      ++weight_[routes_.at(v, to)];
      ++load_[routes_.next_arc(v, to)];
    }
  }

  void search(const std::vector<Choice>& choices) {
    // Of each choice, the arcs that lead nearer, where there are two or more.
    struct Options {
      Choice choice;
      uint32_t first, count;
    };
    std::vector<Options> open;
    std::vector<uint32_t> arcs;
    for (const Choice& choice : choices) {
      const auto first = static_cast<uint32_t>(arcs.size());
      for (uint32_t port = 0; port < graph_.all().degree(choice.from); ++port) {
        if (leads_nearer(choice.from, port, choice.to)) {
          arcs.push_back(graph_.all().arc(choice.from, port));
        }
      }
      const auto count = static_cast<uint32_t>(arcs.size()) - first;
      if (count < 2)
        arcs.resize(first);
      else
        open.push_back({choice, first, count});
    }
    int idle = 0;
    for (uint64_t pass = 0; pass < max_passes && idle < max_idle_passes; ++pass) {
      random_.start(pass);
      bool gained = false;
      for (const auto& [choice, first, count] : open) {
        const uint64_t drawn = uint64_t{random_.bits()} * count >> 32;
        gained |= try_arc(choice, arcs[first + drawn]);
      }
      idle = gained ? 0 : idle + 1;
    }
  }

  /// Takes another next hop, unless the sum of squares grows. True if it shrinks.
  bool try_arc(const Choice& choice, uint32_t new_arc) {
    const auto [from, to] = choice;
    const uint32_t old_arc = routes_.next_arc(from, to);
    if (new_arc == old_arc) return false;
    const int64_t weight = weight_[routes_.at(from, to)];
    const int64_t growth = reroute_growth(old_arc, new_arc, to, weight);
    if (growth > 0) return false;
    carry(old_arc, new_arc, to, weight);
    routes_.port_[routes_.at(from, to)] = static_cast<uint8_t>(new_arc - graph_.all().arc(from, 0));
    return growth < 0;
  }

  /// Calls `both(arc, arc)` for each step of two ways to `to` until they meet: they are as long as
  /// each other.
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

  /// By how much the sum of squares grows: (load + w)^2 - load^2, and the same with -w.
  int64_t reroute_growth(uint32_t old_arc, uint32_t new_arc, Vertex to, int64_t weight) const {
    int64_t growth = 0;
    along(old_arc, new_arc, to, [&](uint32_t from, uint32_t onto) {
      growth += 2 * weight * (load_[onto] - load_[from] + weight);
    });
    return growth;
  }

  void carry(uint32_t old_arc, uint32_t new_arc, Vertex to, int64_t weight) {
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
    for (const bool works : arc_works_) hasher.add(uint64_t{works});
    hasher.add(routes_.hops_.data(), routes_.hops_.size() * sizeof(uint16_t));
    hasher.add(routes_.port_.data(), routes_.port_.size());
    routes_.hash_ = hasher.value();
  }

  const Graph& graph_;
  std::vector<bool> vertex_works_;
  std::vector<bool> arc_works_;
  Random random_;
  Routes routes_;
  std::vector<int64_t> weight_;  // messages that pass a vertex on the way to another: [to][from]
  std::vector<int64_t> load_;    // of an arc
};

Routes balanced_routes(const Graph& graph, const Failures& failures) {
  return RouteBalancer(graph, failures).run();
}

namespace {

/// Sends a message from each worker to each destination, and gives what each arc then carried.
std::vector<uint64_t> carried(const Graph& graph, const Routes& routes, Vertex first_destination,
                              Vertex end_destination) {
  std::vector<uint64_t> load(graph.all().arcs());
  for (Vertex to = first_destination; to < end_destination; ++to) {
    for (Vertex from = 0; from < graph.workers(); ++from) {
      if (from == to || !routes.hops(from, to)) continue;
      for (Vertex v = from; v != to; v = *routes.next_hop(v, to)) ++load[routes.next_arc(v, to)];
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
