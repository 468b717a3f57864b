#include "topology/coordination_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace luxodus {

namespace {

std::vector<uint16_t> hops_from(const Graph& graph, Vertex source) {
  constexpr uint16_t unknown = std::numeric_limits<uint16_t>::max();
  std::vector<uint16_t> hops(graph.vertices(), unknown);
  std::vector<Vertex> reached{source};
  hops[source] = 0;
  for (size_t i = 0; i < reached.size(); ++i) {
    const Vertex v = reached[i];
    if (v != source && !graph.forwards(v)) continue;
    for (const Vertex next : graph.all().of(v)) {
      if (hops[next] != unknown) continue;
      hops[next] = static_cast<uint16_t>(hops[v] + 1);
      reached.push_back(next);
    }
  }
  return hops;
}

/// The vertex nearest to the leader, then repeatedly the one farthest from those chosen.
std::vector<Vertex> centres_of(const Graph& graph, Vertex leader, const std::vector<Vertex>& among,
                               size_t count) {
  std::vector<uint16_t> far = hops_from(graph, leader);
  const auto nearer = [&](Vertex a, Vertex b) { return far[a] < far[b]; };
  std::vector<Vertex> centres{*std::min_element(among.begin(), among.end(), nearer)};
  far.assign(graph.vertices(), std::numeric_limits<uint16_t>::max());
  while (centres.size() < count) {
    const std::vector<uint16_t> hops = hops_from(graph, centres.back());
    for (const Vertex v : among) far[v] = std::min(far[v], hops[v]);
    centres.push_back(*std::max_element(among.begin(), among.end(), nearer));
  }
  return centres;
}

}  // namespace

uint32_t usual_fan_out(uint32_t workers) {
  if (workers < limits::workers_of_one_level) return limits::workers_of_one_level;
  return static_cast<uint32_t>(std::ceil(std::sqrt(workers)));
}

uint32_t chosen_fan_out(uint32_t asked, uint32_t workers, bool one_level) {
  if (asked > 0) return asked;
  return one_level ? std::max(workers, 2u) : usual_fan_out(workers);
}

CoordinationTree::CoordinationTree(const Graph& graph, uint32_t fan_out)
    : parent_(graph.workers(), graph.controller()),
      height_(graph.vertices()),
      tracers_(graph.vertices()),
      hops_(graph.vertices()) {
  std::vector<Vertex> all(graph.workers());
  for (Vertex v = 0; v < graph.workers(); ++v) all[v] = v;
  lead(graph, root(), std::move(all), fan_out);
  measure(root());
}

/// Places each of these vertices below the leader.
void CoordinationTree::lead(const Graph& graph, Vertex leader, std::vector<Vertex> below,
                            uint32_t fan_out) {
  hops_[leader] = hops_from(graph, leader);
  if (below.size() <= fan_out) {
    for (const Vertex v : below) parent_[v] = leader;
    return;
  }
  const size_t needed = (below.size() + fan_out) / (fan_out + 1);
  const std::vector<Vertex> centres =
      centres_of(graph, leader, below, std::min<size_t>(fan_out, needed));
  std::erase_if(below, [&](Vertex v) { return std::count(centres.begin(), centres.end(), v) > 0; });
  std::vector<std::vector<uint16_t>> hops;
  for (const Vertex centre : centres) {
    parent_[centre] = leader;
    hops.push_back(hops_from(graph, centre));
  }
  const size_t room = (below.size() + centres.size() - 1) / centres.size();
  std::vector<std::vector<Vertex>> clusters(centres.size());
  for (const Vertex v : below) {
    size_t best = centres.size();
    for (size_t c = 0; c < centres.size(); ++c)
      if (clusters[c].size() < room && (best == centres.size() || hops[c][v] < hops[best][v]))
        best = c;
    clusters[best].push_back(v);
  }
  for (size_t c = 0; c < centres.size(); ++c)
    lead(graph, centres[c], std::move(clusters[c]), fan_out);
}

void CoordinationTree::measure(Vertex v) {
  const std::vector<Vertex> below = children(v);
  tracers_[v] = below.empty() ? 1 : 0;
  for (const Vertex child : below) {
    measure(child);
    height_[v] = std::max(height_[v], height_[child] + 1);
    tracers_[v] += tracers_[child];
  }
}

std::vector<Vertex> CoordinationTree::children(Vertex v) const {
  std::vector<Vertex> found;
  for (Vertex child = 0; child < parent_.size(); ++child)
    if (parent_[child] == v) found.push_back(child);
  return found;
}

std::vector<Vertex> CoordinationTree::coordinators_of(Vertex v) const {
  if (parent(v) == root()) return {root()};
  std::vector<Vertex> found;
  for (Vertex c = 0; c <= root(); ++c)
    if (c != v && height(c) > height(v)) found.push_back(c);
  const auto order = [&](Vertex c) {
    return std::tuple(c != parent(v), c == root(), hops_[c][v], c);
  };
  std::sort(found.begin(), found.end(), [&](Vertex a, Vertex b) { return order(a) < order(b); });
  return found;
}

}  // namespace luxodus
