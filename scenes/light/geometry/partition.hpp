// Cuts triangles into spatially compact cells, each of which becomes a scene of its own for ray
// casting. The partition can change bits of results (a ray that hits an edge may choose another
// triangle), so it depends on its arguments alone: no threads, no hashing, no rounding of sums.
// Pure function; any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace luxodus {

/// Returns exactly min(cells, triangles) cells (cells below 1 count as 1), none empty, of nearly
/// equal sizes; each triangle belongs to one cell, and indices ascend within a cell. Uses median
/// cuts across the longest side of the box of the centroids; equal coordinates are ordered by
/// index. Without triangles there are no cells. Requires: finite centroids, at most 2^32 - 1 of
/// them.
std::vector<std::vector<uint32_t>> partition_triangles(std::span<const glm::dvec3> centroids,
                                                       int cells);

}  // namespace luxodus
