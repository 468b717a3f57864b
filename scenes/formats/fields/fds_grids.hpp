// Lays meshes of a fire simulation out as grids of even cells, which rays walk through. Meshes on
// one lattice share a grid; cells between them are clear. A stretched mesh is resampled to finer
// even cells. Where its cells are wholes of such cells, nothing is lost. Else the integral of every
// quantity is kept, and a face between two cells is displaced by at most half such a fine cell.
// Plain values and pure functions; any thread.
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
  bool nested = false;  // resampled, with all faces of its mesh's cells on faces of its own

  uint64_t cell_count() const {
    return static_cast<uint64_t>(cells.x) * static_cast<uint64_t>(cells.y) *
           static_cast<uint64_t>(cells.z);
  }
};

/// Grids for all meshes of a case, in the order of their first meshes.
/// Errors: cells that exceed this machine's memory; a stretched mesh that, in even cells of about
/// its smallest one, would have more than limits::max_grid_side along an axis or
/// limits::max_grid_cells.
Result<std::vector<Grid>> plan_grids(const Case& fire);

/// Clears cells that an earlier mesh covers: where meshes overlap, FDS uses the first. Returns how
/// many cells with a value were cleared.
size_t clear_overlapped(const Case& fire, size_t mesh, std::vector<float>& cells);

/// Copies the cells of a mesh to their places in a grid. `to`: the grid's cells. Requires: `mesh`
/// belongs to the grid.
void put(const Grid& grid, const Mesh& mesh, const std::vector<float>& cells,
         std::vector<float>& to);

}  // namespace luxodus::fds
