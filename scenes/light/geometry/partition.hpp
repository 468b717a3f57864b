// Cuts triangles into cells of neighbours, each of which becomes a scene of its own for ray
// casting. The partition is part of what decides bits (a ray that meets an edge may choose another
// triangle), so it depends on nothing but its arguments: no threads, no hashing, no rounding of
// sums.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace luxodus {

/// Exactly min(cells, triangles) cells (cells below 1 count as 1), none empty, of nearly equal
/// numbers; every triangle whole in one cell, ascending within it. Median cuts across the longest
/// side of the box of the centroids; equal coordinates go by index, lower first. No triangles: no
/// cells. Requires: finite centroids, at most 2^32 - 1 of them.
std::vector<std::vector<uint32_t>> partition_triangles(std::span<const glm::dvec3> centroids,
                                                       int cells);

}  // namespace luxodus
