// Meshes of a fire simulation as grids of even cells, which are what rays walk through. Meshes that
// lie on one lattice share a grid; cells between them are clear. A stretched mesh is resampled to
// finer even cells: the integral of every quantity is kept, and a face between two cells lies up to
// half of such a fine cell from its place. Any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

struct Grid {
  glm::dvec3 low{0};      // [m]
  glm::dvec3 spacing{0};  // edges of a cell [m]
  glm::ivec3 cells{0};
  std::vector<size_t> meshes;
  bool resampled = false;

  uint64_t cell_count() const {
    return static_cast<uint64_t>(cells.x) * static_cast<uint64_t>(cells.y) *
           static_cast<uint64_t>(cells.z);
  }
};

/// Grids for all meshes of a case, in the order of their first meshes.
/// Errors: cells that take more memory than this machine has; a mesh that is stretched by more than
/// 8192 of its smallest cells' halves.
Result<std::vector<Grid>> plan_grids(const Case& fire);

/// Clears cells that lie in a mesh before this one: FDS takes the first of meshes that overlap.
/// Returns how many were cleared that hold anything.
size_t clear_overlapped(const Case& fire, size_t mesh, std::vector<float>& cells);

/// Writes the cells of a mesh to their places. `to`: of the grid's cells. Requires: `mesh` is one
/// of the grid.
void put(const Grid& grid, const Mesh& mesh, const std::vector<float>& cells,
         std::vector<float>& to);

}  // namespace luxodus::fds
