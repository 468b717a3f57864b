#include "topology/distances.hpp"

#include <algorithm>
#include <bit>

namespace luxodus {

PathLengths path_lengths(const Adjacency& graph) {
  const size_t n = graph.vertices();
  const size_t words = (n + 63) / 64;
  // Row v holds the sources that have reached v so far.
  std::vector<uint64_t> reached(n * words);
  for (size_t v = 0; v < n; ++v) reached[v * words + v / 64] |= uint64_t{1} << (v % 64);
  std::vector<uint64_t> next(reached);

  PathLengths lengths;
  lengths.pairs = uint64_t{n} * (n - 1);
  uint64_t missing = lengths.pairs;
  while (missing > 0) {
    uint64_t have = 0;
    for (Vertex v = 0; v < n; ++v) {
      uint64_t* row = &next[v * words];
      for (const Vertex from : graph.of(v)) {
        const uint64_t* other = &reached[from * words];
        for (size_t w = 0; w < words; ++w) row[w] |= other[w];
      }
      for (size_t w = 0; w < words; ++w) have += static_cast<uint64_t>(std::popcount(row[w]));
    }
    const uint64_t still = lengths.pairs + n - have;
    if (still == missing) break;
    // A pair first reached after k hops was missing k times before.
    lengths.hops += missing;
    missing = still;
    ++lengths.diameter;
    reached = next;
  }
  lengths.hops -= missing * lengths.diameter;
  lengths.unconnected = missing;
  return lengths;
}

PathLengths hop_bound(std::span<const uint32_t> degrees) {
  PathLengths bound;
  bound.pairs = uint64_t{degrees.size()} * (degrees.size() - 1);
  std::vector<uint64_t> walks(degrees.begin(), degrees.end());
  for (uint64_t left = bound.pairs; left > 0;) {
    uint64_t layer = 0;
    for (size_t v = 0; v < degrees.size(); ++v) {
      layer += walks[v];
      // Capped at all pairs, so that no power overflows.
      walks[v] = std::min(walks[v] * (std::max(degrees[v], 1u) - 1), bound.pairs);
    }
    if (layer == 0) break;  // too few links to connect them: no walk continues
    layer = std::min(layer, left);
    ++bound.diameter;
    bound.hops += layer * bound.diameter;
    left -= layer;
  }
  return bound;
}

std::vector<uint32_t> full_worker_degrees(uint32_t nodes, uint32_t links,
                                          uint32_t controller_links) {
  const uint32_t most = std::min(links, nodes - 1);
  std::vector<uint32_t> degrees(nodes, most);
  // A node with more links than partners gives a spare one to the controller.
  if (links < nodes) {
    for (uint32_t i = 0; i < controller_links; ++i) --degrees[i % nodes];
  }
  uint64_t sum = 0;
  for (const uint32_t degree : degrees) sum += degree;
  if (sum % 2 == 1) --degrees.back();
  return degrees;
}

std::vector<uint32_t> full_degrees(uint32_t nodes, uint32_t links, uint32_t controller_links) {
  std::vector<uint32_t> degrees = full_worker_degrees(nodes, links, controller_links);
  if (controller_links == 0) return degrees;
  for (uint32_t i = 0; i < controller_links; ++i) ++degrees[i % nodes];
  degrees.push_back(controller_links);
  return degrees;
}

PathLengths controller_bound(uint32_t nodes, uint32_t links, uint32_t controller_links) {
  PathLengths bound;
  bound.pairs = nodes;
  uint64_t layer = controller_links;
  for (uint64_t left = nodes; left > 0 && layer > 0;) {
    layer = std::min(layer, left);
    ++bound.diameter;
    bound.hops += layer * bound.diameter;
    left -= layer;
    layer *= links - 1;
  }
  return bound;
}

}  // namespace luxodus
