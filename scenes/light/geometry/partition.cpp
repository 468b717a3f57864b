#include "scenes/light/geometry/partition.hpp"

#include <algorithm>
#include <numeric>

#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {
namespace {

struct CellRange {
  size_t first, last;  // range in the order
  size_t cells;
};

/// Ties go to x before y before z.
int longest_axis(const Bounds& bounds) {
  const glm::dvec3 side = bounds.high - bounds.low;
  int axis = 0;
  if (side.y > side[axis]) axis = 1;
  if (side.z > side[axis]) axis = 2;
  return axis;
}

}  // namespace

std::vector<std::vector<uint32_t>> partition_triangles(std::span<const glm::dvec3> centroids,
                                                       int cells) {
  std::vector<std::vector<uint32_t>> out;
  if (centroids.empty()) return out;
  std::vector<uint32_t> order(centroids.size());
  std::iota(order.begin(), order.end(), 0u);
  const size_t wanted = std::min(centroids.size(), static_cast<size_t>(std::max(cells, 1)));
  out.reserve(wanted);

  // Depth first, the lower side first: cells come out in spatial order. A part always holds at
  // least as many triangles as cells, so no cell is empty.
  std::vector<CellRange> open = {{0, order.size(), wanted}};
  while (!open.empty()) {
    const CellRange task = open.back();
    open.pop_back();
    if (task.cells == 1) {
      std::vector<uint32_t> cell(order.begin() + static_cast<ptrdiff_t>(task.first),
                                 order.begin() + static_cast<ptrdiff_t>(task.last));
      std::sort(cell.begin(), cell.end());
      out.push_back(std::move(cell));
      continue;
    }
    Bounds bounds;
    for (size_t k = task.first; k < task.last; ++k) bounds.extend(centroids[order[k]]);
    const int axis = longest_axis(bounds);
    const size_t count = task.last - task.first;
    const size_t low_cells = task.cells / 2;
    // count * low_cells / cells without a product that could overflow; at least one triangle per
    // cell.
    const size_t share =
        count / task.cells * low_cells + count % task.cells * low_cells / task.cells;
    const size_t middle = task.first + share;
    std::nth_element(order.begin() + static_cast<ptrdiff_t>(task.first),
                     order.begin() + static_cast<ptrdiff_t>(middle),
                     order.begin() + static_cast<ptrdiff_t>(task.last),
                     [&](uint32_t a, uint32_t b) {
                       const double pa = centroids[a][axis], pb = centroids[b][axis];
                       return pa < pb || (pa == pb && a < b);
                     });
    open.push_back({middle, task.last, task.cells - low_cells});
    open.push_back({task.first, middle, low_cells});
  }
  return out;
}

}  // namespace luxodus
