#include "scenes/formats/fields/fds_grids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/formats/fields/data_set_fields.hpp"
#include "scenes/light/optics/smoke_grid.hpp"

namespace luxodus::fds {

namespace {

/// Nodes are written with five decimals. Node coordinates may deviate from a lattice by this, or by
/// this share of a cell, which changes an optical depth by at most that share of one cell's.
constexpr double written_m = 2e-5, lattice_share = 1e-3;
/// A common grid may have this many times the cells of its meshes: the additional cells are clear,
/// and cost 4 bytes each.
constexpr uint64_t spare_factor = 4, spare_cells = 100'000;
/// Values for a cell while it is read: extinction, emission, masks, node values.
constexpr uint64_t floats_per_cell = 5;
/// Parts of the smallest cell that are tried as even cells: 0.2 and 0.3 m need 2, 0.4 and 0.5 m 4.
/// Halves are always taken; more only where the grid has at most so many cells for one of the mesh.
constexpr int most_parts = 5, halves = 2;
constexpr uint64_t fine_factor = 64;

double slack(double cell_m) {
  return std::max(written_m, lattice_share * cell_m);
}

bool is_even(const std::vector<double>& nodes) {
  const auto n = static_cast<double>(nodes.size() - 1);
  const double step = (nodes.back() - nodes.front()) / n;
  for (size_t i = 0; i < nodes.size(); ++i)
    if (std::abs(nodes[i] - (nodes.front() + step * static_cast<double>(i))) > slack(step))
      return false;
  return true;
}

/// Even cells along an axis, and whether all nodes fall on their faces.
struct EvenCells {
  int count = 0;  // 0: too many
  bool nested = false;
};

/// The fewest even cells on whose faces all nodes fall, where few parts of the smallest cell are
/// enough; else halves of the smallest cell.
EvenCells even_cells(const std::vector<double>& nodes, int finest) {
  if (is_even(nodes)) return {static_cast<int>(nodes.size()) - 1, true};
  const double length = nodes.back() - nodes.front();
  double smallest = length;
  for (size_t i = 1; i < nodes.size(); ++i) smallest = std::min(smallest, nodes[i] - nodes[i - 1]);
  const auto count_of = [&](int parts) { return std::round(length / smallest * parts); };
  for (int parts = 1; parts <= finest && count_of(parts) <= luxodus::limits::max_grid_side;
       ++parts) {
    const double count = count_of(parts), step = length / count;
    const bool fits = std::all_of(nodes.begin(), nodes.end(), [&](double x) {
      const double place = (x - nodes.front()) / step;
      return std::abs(place - std::round(place)) * step <= slack(step);
    });
    if (fits) return {static_cast<int>(count), true};
  }
  if (!(count_of(2) <= luxodus::limits::max_grid_side)) return {};
  return {static_cast<int>(count_of(2)), false};
}

/// The mesh's first cell on the lattice of a grid; none where it is off the lattice.
std::optional<glm::dvec3> place_on(const Grid& grid, const Mesh& mesh) {
  glm::dvec3 first;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = grid.spacing[axis];
    first[axis] = std::round((mesh.low()[axis] - grid.low[axis]) / step);
    const double low = grid.low[axis] + first[axis] * step;
    const double high = low + step * mesh.cells[axis];
    if (std::abs(low - mesh.low()[axis]) > slack(step) ||
        std::abs(high - mesh.high()[axis]) > slack(step))
      return std::nullopt;
  }
  return first;
}

/// Adds a mesh to a grid, if it lies on its lattice and few clear cells are added.
bool joins(Grid& grid, const Mesh& mesh, uint64_t cells_of_meshes) {
  const auto first = place_on(grid, mesh);
  if (!first) return false;
  const glm::dvec3 low = glm::min(glm::dvec3(0), *first);
  const glm::dvec3 high = glm::max(glm::dvec3(grid.cells), *first + glm::dvec3(mesh.cells));
  const glm::dvec3 size = high - low;
  if (glm::any(glm::greaterThan(size, glm::dvec3(luxodus::limits::max_grid_side)))) return false;
  const double most = static_cast<double>(spare_factor * (cells_of_meshes + mesh.cell_count())) +
                      static_cast<double>(spare_cells);
  const double count = size.x * size.y * size.z;
  if (count > most || count > static_cast<double>(luxodus::limits::max_grid_cells)) return false;
  grid.low += low * grid.spacing;
  grid.cells = glm::ivec3(size);
  return true;
}

/// Which cells of a mesh each even cell overlaps, and by how much, along one axis.
struct Overlap {
  int cell = 0;
  int from = 0;
  double share = 0;  // share of the even cell's length
};

std::vector<Overlap> overlaps_along(const Grid& grid, const Mesh& mesh, int axis) {
  const std::vector<double>& nodes = mesh.nodes[static_cast<size_t>(axis)];
  std::vector<Overlap> out;
  const double step = grid.spacing[axis];
  size_t from = 0;
  for (int cell = 0; cell < grid.cells[axis]; ++cell) {
    const double low = grid.low[axis] + cell * step, high = low + step;
    while (from + 2 < nodes.size() && nodes[from + 1] <= low) ++from;
    for (size_t i = from; i + 1 < nodes.size(); ++i) {
      const double share = (std::min(high, nodes[i + 1]) - std::max(low, nodes[i])) / step;
      if (share > 0) out.push_back({cell, static_cast<int>(i), share});
      if (nodes[i + 1] >= high) break;
    }
  }
  return out;
}

void put_resampled(const Grid& grid, const Mesh& mesh, const std::vector<float>& cells,
                   std::vector<float>& to) {
  const auto along_x = overlaps_along(grid, mesh, 0), along_y = overlaps_along(grid, mesh, 1),
             along_z = overlaps_along(grid, mesh, 2);
  const auto at = [](const glm::ivec3& n, int x, int y, int z) {
    return (static_cast<size_t>(z) * static_cast<size_t>(n.y) + static_cast<size_t>(y)) *
               static_cast<size_t>(n.x) +
           static_cast<size_t>(x);
  };
  for (const Overlap& z : along_z)
    for (const Overlap& y : along_y)
      for (const Overlap& x : along_x)
        to[at(grid.cells, x.cell, y.cell, z.cell)] +=
            static_cast<float>(x.share * y.share * z.share) *
            cells[at(mesh.cells, x.from, y.from, z.from)];
}

/// A grid of its own for a mesh.
Result<Grid> grid_of(const Case& fire, const Mesh& mesh, int parts) {
  Grid grid;
  grid.low = mesh.low();
  grid.resampled = !std::all_of(mesh.nodes.begin(), mesh.nodes.end(), is_even);
  grid.nested = grid.resampled;
  for (int axis = 0; axis < 3; ++axis) {
    const EvenCells along = even_cells(mesh.nodes[static_cast<size_t>(axis)], parts);
    grid.cells[axis] = along.count;
    grid.nested = grid.nested && along.nested;
    if (along.count == 0)
      return problem_in(fire.file, mesh.line,
                        fmt::format("this mesh is stretched along {}: in even cells of about its "
                                    "smallest cell it would have more than {} there, which is the "
                                    "most that is read; stretch it less",
                                    "xyz"[axis], luxodus::limits::max_grid_side));
  }
  grid.spacing = (mesh.high() - mesh.low()) / glm::dvec3(grid.cells);
  return grid;
}

}  // namespace

Result<std::vector<Grid>> plan_grids(const Case& fire) {
  std::vector<Grid> grids;
  std::vector<uint64_t> cells_of_meshes;
  for (size_t i = 0; i < fire.meshes.size(); ++i) {
    const Mesh& mesh = fire.meshes[i];
    const bool even = std::all_of(mesh.nodes.begin(), mesh.nodes.end(), is_even);
    bool joined = false;
    for (size_t g = 0; even && g < grids.size() && !joined; ++g) {
      if (grids[g].resampled || !joins(grids[g], mesh, cells_of_meshes[g])) continue;
      grids[g].meshes.push_back(i);
      cells_of_meshes[g] += mesh.cell_count();
      joined = true;
    }
    if (joined) continue;
    auto grid = grid_of(fire, mesh, most_parts);
    if (grid && grid->cell_count() > fine_factor * mesh.cell_count())
      grid = grid_of(fire, mesh, halves);
    if (!grid) return grid.problem();
    if (grid->cell_count() > static_cast<uint64_t>(luxodus::limits::max_grid_cells))
      return problem_in(fire.file, mesh.line,
                        fmt::format("this mesh is stretched: in even cells of about its smallest "
                                    "cell it would have {}, and at most {} are read; stretch it "
                                    "less",
                                    grid->cell_count(), luxodus::limits::max_grid_cells));
    grid->meshes = {i};
    grids.push_back(std::move(grid.value()));
    cells_of_meshes.push_back(mesh.cell_count());
  }
  uint64_t all = 0;
  for (const Grid& grid : grids) all += grid.cell_count();
  for (const Mesh& mesh : fire.meshes) all += mesh.cell_count();
  if (auto ok = data_set::check_memory(all, floats_per_cell); !ok)
    return problem_in(fire.file, ok.problem());
  return grids;
}

size_t clear_overlapped(const Case& fire, size_t mesh, std::vector<float>& cells) {
  const Mesh& m = fire.meshes[mesh];
  size_t cleared = 0;
  for (size_t before = 0; before < mesh; ++before) {
    const Mesh& first = fire.meshes[before];
    const glm::dvec3 low = first.low(), high = first.high();
    if (glm::any(glm::greaterThanEqual(low, m.high())) ||
        glm::any(glm::lessThanEqual(high, m.low())))
      continue;
    glm::ivec3 begin(0), end(0);
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double>& nodes = m.nodes[static_cast<size_t>(axis)];
      const auto inside = [&](int cell) {
        const auto i = static_cast<size_t>(cell);
        const double middle = 0.5 * (nodes[i] + nodes[i + 1]);
        return middle > low[axis] && middle < high[axis];
      };
      while (begin[axis] < m.cells[axis] && !inside(begin[axis])) ++begin[axis];
      for (end[axis] = begin[axis]; end[axis] < m.cells[axis] && inside(end[axis]);) ++end[axis];
    }
    for (int z = begin.z; z < end.z; ++z)
      for (int y = begin.y; y < end.y; ++y)
        for (int x = begin.x; x < end.x; ++x) {
          float& cell = cells[(static_cast<size_t>(z) * static_cast<size_t>(m.cells.y) +
                               static_cast<size_t>(y)) *
                                  static_cast<size_t>(m.cells.x) +
                              static_cast<size_t>(x)];
          cleared += cell != 0 ? 1 : 0;
          cell = 0;
        }
  }
  return cleared;
}

void put(const Grid& grid, const Mesh& mesh, const std::vector<float>& cells,
         std::vector<float>& to) {
  if (grid.resampled) return put_resampled(grid, mesh, cells, to);
  const glm::ivec3 first(glm::round((mesh.low() - grid.low) / grid.spacing));
  size_t from = 0;
  for (int z = 0; z < mesh.cells.z; ++z)
    for (int y = 0; y < mesh.cells.y; ++y) {
      const size_t row = (static_cast<size_t>(first.z + z) * static_cast<size_t>(grid.cells.y) +
                          static_cast<size_t>(first.y + y)) *
                             static_cast<size_t>(grid.cells.x) +
                         static_cast<size_t>(first.x);
      for (int x = 0; x < mesh.cells.x; ++x, ++from)
        // Cells of a mesh that another one covers are 0 here; the grid may hold the other's values
        // there.
        if (cells[from] != 0) to[row + static_cast<size_t>(x)] = cells[from];
    }
}

}  // namespace luxodus::fds
