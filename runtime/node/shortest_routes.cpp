#include "runtime/node/shortest_routes.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// Neighbours of every node, in ascending order.
std::vector<std::vector<uint16_t>> neighbours_of(size_t nodes, std::span<const Edge> links,
                                                 std::span<const Edge> down) {
  std::vector<std::vector<uint16_t>> neighbours(nodes);
  for (const Edge& link : links) {
    if (std::find(down.begin(), down.end(), link) != down.end()) continue;
    neighbours[link.a.value].push_back(link.b.value);
    neighbours[link.b.value].push_back(link.a.value);
  }
  for (auto& list : neighbours) std::sort(list.begin(), list.end());
  return neighbours;
}

}  // namespace

std::vector<Edge> all_pairs(size_t nodes) {
  std::vector<Edge> links;
  for (uint16_t a = 0; a < nodes; ++a)
    for (auto b = static_cast<uint16_t>(a + 1); b < nodes; ++b) links.push_back({{a}, {b}});
  return links;
}

NextHops shortest_routes(NodeId self, size_t nodes, std::span<const Edge> links,
                         std::span<const Edge> down) {
  const auto neighbours = neighbours_of(nodes, links, down);
  NextHops hops;
  hops.next.assign(nodes, no_node);
  std::vector<uint16_t> reached{self.value};
  for (size_t n = 0; n < reached.size(); ++n) {
    const uint16_t at = reached[n];
    for (const uint16_t next : neighbours[at]) {
      if (next == self.value || hops.next[next] != no_node) continue;
      hops.next[next] = at == self.value ? NodeId{next} : hops.next[at];
      reached.push_back(next);
    }
  }
  return hops;
}

size_t longest_route(size_t nodes, std::span<const Edge> links) {
  const auto neighbours = neighbours_of(nodes, links, {});
  size_t longest = 0;
  for (uint16_t from = 0; from < nodes; ++from) {
    std::vector<size_t> distance(nodes, SIZE_MAX);
    std::vector<uint16_t> reached{from};
    distance[from] = 0;
    for (size_t n = 0; n < reached.size(); ++n)
      for (const uint16_t next : neighbours[reached[n]])
        if (distance[next] == SIZE_MAX) {
          distance[next] = distance[reached[n]] + 1;
          reached.push_back(next);
        }
    if (reached.size() < nodes) return 0;
    longest = std::max(longest, distance[reached.back()]);
  }
  return longest;
}

}  // namespace luxodus
