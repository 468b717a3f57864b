#include "topology/layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "runtime/core/random.hpp"
#include "topology/lift.hpp"

namespace luxodus {
namespace {

// Half turns look alike in every drawing; from thirds on a circle shows the symmetry better.
constexpr uint32_t min_circle_rotation = 3;

/// Positions of a rotational graph on its circle: base vertex b is at position slot(b) of each
/// part, and its copies begin some parts later. Both are exchanged while the links get shorter.
class CircleOrder {
 public:
  explicit CircleOrder(const Graph& graph)
      : nodes_(graph.workers()), base_(nodes_ / graph.rotation()), links_of_(base_) {
    for (const GraphLink& link : links_among(nodes_, graph.links())) {
      // All copies of a link have equal length: those at the first part represent the rest.
      if (link.a < base_) links_of_[link.a].push_back(link);
      if (link.b < base_ || (link.b % base_ != link.a % base_ && link.a < base_))
        links_of_[link.b % base_].push_back(link);
    }
  }

  /// The position of each worker around the circle, from 0 to workers - 1.
  std::vector<uint32_t> best() {
    constexpr uint64_t starts = 30;
    uint64_t least = UINT64_MAX;
    std::vector<uint32_t> best;
    for (uint64_t start = 0; start < starts; ++start) {
      random_.start(start);
      arrange_at_random(start > 0);
      improve();
      if (const uint64_t length = whole_length(); length < least) {
        least = length;
        best.resize(nodes_);
        for (Vertex v = 0; v < nodes_; ++v) best[v] = place(v);
      }
    }
    return best;
  }

 private:
  uint32_t place(Vertex v) const {
    return ((v / base_ + part_[v % base_]) * base_ + slot_[v % base_]) % nodes_;
  }

  uint64_t length(const std::vector<GraphLink>& links) const {
    uint64_t sum = 0;
    for (const GraphLink& link : links) {
      const uint32_t apart = (place(link.a) + nodes_ - place(link.b)) % nodes_;
      sum += std::min(apart, nodes_ - apart);
    }
    return sum;
  }

  uint64_t whole_length() const {
    uint64_t sum = 0;
    for (const auto& links : links_of_) sum += length(links);
    return sum;
  }

  void arrange_at_random(bool shuffled) {
    slot_.resize(base_);
    std::iota(slot_.begin(), slot_.end(), 0u);
    part_.assign(base_, 0);
    for (uint32_t i = base_; shuffled && i > 1; --i) {
      std::swap(slot_[i - 1], slot_[random_below(random_, i)]);
      part_[i - 1] = random_below(random_, nodes_ / base_);
    }
  }

  void improve() {
    const uint64_t tries = 400 * uint64_t{base_};
    for (uint64_t i = 0; i < tries; ++i) {
      const uint32_t a = random_below(random_, base_), b = random_below(random_, base_);
      const uint32_t part_of_a = part_[a];
      const uint64_t before = length(links_of_[a]) + length(links_of_[b]);
      part_[a] = random_below(random_, nodes_ / base_);
      std::swap(slot_[a], slot_[b]);
      if (length(links_of_[a]) + length(links_of_[b]) <= before) continue;
      std::swap(slot_[a], slot_[b]);
      part_[a] = part_of_a;
    }
  }

  uint32_t nodes_, base_;
  std::vector<std::vector<GraphLink>> links_of_;  // by base vertex
  std::vector<uint32_t> slot_, part_;
  Random random_{0, RandomStream::graph};
};

std::vector<DrawnPlace> on_circle(const Graph& graph) {
  // Links between neighbours would overlap on the rim: every second vertex moves inwards.
  constexpr uint32_t min_zigzag_base = 4;
  constexpr double inner_radius = 0.78;
  const uint32_t base = graph.workers() / graph.rotation();
  const std::vector<uint32_t> order = CircleOrder(graph).best();
  std::vector<DrawnPlace> places(graph.vertices());  // the controller stays in the centre
  for (Vertex v = 0; v < graph.workers(); ++v) {
    const double angle = 2 * std::numbers::pi * order[v] / graph.workers();
    const double radius = order[v] % base % 2 == 0 || base < min_zigzag_base ? 1 : inner_radius;
    places[v] = {radius * std::sin(angle), radius * std::cos(angle)};
  }
  return places;
}

/// Hops between all vertices, row by row. Requires: connected.
std::vector<double> hops_of_all(const Adjacency& graph) {
  const size_t n = graph.vertices();
  std::vector<double> hops(n * n, -1);
  for (Vertex from = 0; from < n; ++from) {
    double* row = &hops[from * n];
    std::vector<Vertex> queue{from};
    row[from] = 0;
    for (size_t i = 0; i < queue.size(); ++i) {
      for (const Vertex to : graph.of(queue[i])) {
        if (row[to] >= 0) continue;
        row[to] = row[queue[i]] + 1;
        queue.push_back(to);
      }
    }
  }
  return hops;
}

/// Classical scaling (Torgerson 1952): the two main axes of a set of points with these distances,
/// by power iteration.
std::vector<DrawnPlace> main_axes(const std::vector<double>& hops, size_t n) {
  constexpr int rounds = 60;
  std::vector<double> mean(n);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) mean[i] += hops[i * n + j] * hops[i * n + j] / double(n);
  }
  const double all = std::accumulate(mean.begin(), mean.end(), 0.0) / double(n);
  std::vector<double> first(n), second(n);
  for (size_t i = 0; i < n; ++i) {
    first[i] = std::sin(1.0 + double(i));
    second[i] = std::cos(2.0 * double(i));
  }
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  const auto turned_to_axis = [&](const std::vector<double>& v) {
    std::vector<double> out(n);
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j < n; ++j) {
        const double d = hops[i * n + j];
        out[i] -= (d * d - mean[i] - mean[j] + all) / 2 * v[j];
      }
    }
    const double size = std::sqrt(dot(out, out));
    for (double& x : out) x /= std::max(size, 1e-300);
    return out;
  };
  for (int round = 0; round < rounds; ++round) {
    first = turned_to_axis(first);
    second = turned_to_axis(second);
    const double shared = dot(first, second);
    for (size_t i = 0; i < n; ++i) second[i] -= shared * first[i];
  }
  std::vector<DrawnPlace> places(n);
  for (size_t i = 0; i < n; ++i) places[i] = {first[i], second[i]};
  return places;
}

/// Stress majorisation (Gansner, Koren, North, "Graph drawing by stress majorization", GD 2004),
/// weights 1 / hops^2.
void lessen_stress(std::vector<DrawnPlace>& places, const std::vector<double>& hops) {
  constexpr int rounds = 150;
  const size_t n = places.size();
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < n; ++i) {
      DrawnPlace sum;
      double weights = 0;
      for (size_t j = 0; j < n; ++j) {
        if (i == j) continue;
        const double wanted = hops[i * n + j];
        const double dx = places[i].x - places[j].x, dy = places[i].y - places[j].y;
        const double scale = wanted / std::max(std::hypot(dx, dy), 1e-9);
        const double weight = 1 / (wanted * wanted);
        sum.x += weight * (places[j].x + scale * dx);
        sum.y += weight * (places[j].y + scale * dy);
        weights += weight;
      }
      if (weights > 0) places[i] = {sum.x / weights, sum.y / weights};
    }
  }
}

void fit_into_disc(std::vector<DrawnPlace>& places) {
  DrawnPlace middle;
  for (const DrawnPlace& p : places) {
    middle.x += p.x / double(places.size());
    middle.y += p.y / double(places.size());
  }
  double radius = 1e-9;
  for (DrawnPlace& p : places) {
    p = {p.x - middle.x, p.y - middle.y};
    radius = std::max(radius, std::hypot(p.x, p.y));
  }
  for (DrawnPlace& p : places) p = {p.x / radius, p.y / radius};
}

}  // namespace

std::vector<DrawnPlace> layout(const Graph& graph) {
  if (graph.rotation() >= min_circle_rotation) return on_circle(graph);
  const std::vector<double> hops = hops_of_all(graph.all());
  std::vector<DrawnPlace> places = main_axes(hops, graph.vertices());
  // Coordinates on the axes have total length 1: scaled to the size of hops.
  for (DrawnPlace& p : places) {
    p.x *= std::sqrt(double(graph.vertices()));
    p.y *= std::sqrt(double(graph.vertices()));
  }
  lessen_stress(places, hops);
  fit_into_disc(places);
  return places;
}

}  // namespace luxodus
