// A 3-D array of smoke in a placed and turned box: rays cross its cells exactly, by integer steps.
// The arrays are cut into bricks of 16^3 cells, which are the scene parts that machines exchange;
// the grid itself keeps only what every machine needs: the box, and which bricks are clear. Bricks
// are read only through a resolver:
//   const Brick& resolver.brick(int medium, int brick)     valid until the next call.
// A grid is immutable once made; any thread. A BrickReader and a GridCursor belong to one ray.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/medium.hpp"
#include "scenes/light/optics/ray_interval.hpp"

namespace luxodus {

namespace limits {
/// Cells along one side of a brick, a power of two: 4096 cells, 16 kB per quantity. Half of it
/// would double the messages for a ray; twice as much (128 kB) would make fetches too large.
inline constexpr int brick_side = 16;
inline constexpr int brick_cells = brick_side * brick_side * brick_side;
/// Cells along one side of a data set: indices and their products stay far inside 32 and 64 bits.
inline constexpr int max_grid_side = 8192;
/// Cells of one data set: 4 GB of extinction.
inline constexpr int64_t max_grid_cells = int64_t{1} << 30;
}  // namespace limits

/// 16^3 cells, x fastest; cells beyond the data set's end are zero. A quantity that the data set
/// lacks has an empty array.
struct Brick {
  std::vector<float> extinction;  // [1/m] at the medium's wavelength, before any factor
  std::vector<float> albedo;
  std::vector<float> emission;              // relative strength per volume
  std::vector<double> emission_cumulative;  // running sum of emission, this cell included
  uint64_t content = 0;  // XXH3 of the arrays: bricks of equal content have equal names

  static int cell_index(const glm::ivec3& cell) {
    constexpr int low = limits::brick_side - 1;
    return ((cell.z & low) * limits::brick_side + (cell.y & low)) * limits::brick_side +
           (cell.x & low);
  }
  size_t bytes() const {
    return sizeof(*this) + sizeof(float) * (extinction.size() + albedo.size() + emission.size()) +
           sizeof(double) * emission_cumulative.size();
  }
};

/// A brick with 4096 zeros for each quantity.
const Brick& clear_brick();

/// Facts about a brick that a tracer has before it reads it.
struct BrickSummary {
  bool smokes = false;  // some cell has extinction
  double emission = 0;  // sum over its cells

  friend bool operator==(const BrickSummary&, const BrickSummary&) = default;
};

/// Facts about a data set's arrays that every machine keeps: which exist, and a summary of each
/// brick.
struct BrickTable {
  bool has_extinction = false;
  bool has_albedo = false;
  bool has_emission = false;
  std::vector<BrickSummary> bricks;  // in the order of SmokeGrid::brick_of

  /// Whether rays may skip the brick: it has neither extinction nor emission. `emits`: the medium
  /// has emission.
  bool clear(size_t brick, bool emits, bool interpolates) const {
    const bool glows = emits && (!has_emission || interpolates || bricks[brick].emission > 0);
    return has_extinction && !bricks[brick].smokes && !glows;
  }
  bool has_arrays() const { return has_extinction || has_albedo || has_emission; }
  friend bool operator==(const BrickTable&, const BrickTable&) = default;
};

/// Number of bricks along each side of a data set, and in total.
glm::ivec3 bricks_along(const DataSet& data);
size_t brick_count(const DataSet& data);

/// Cuts one brick from a data set that holds its arrays.
Brick cut_brick(const DataSet& data, size_t brick);
/// Computes what follows from a brick's arrays: the running sum of emission, and the name.
void complete(Brick& brick);
BrickSummary summary_of(const Brick& brick);
/// The table of a data set that holds its arrays; cuts one brick at a time.
BrickTable brick_table(const DataSet& data);

/// Reads through a resolver, and calls it only if the brick changes: a returned brick is valid
/// until the next one is read. One per ray.
template <class Resolver>
class BrickReader {
 public:
  explicit BrickReader(Resolver& resolver) : resolver_(&resolver) {}

  const Brick& at(int medium, int brick) {
    if (medium != medium_ || brick != brick_) {
      held_ = &resolver_->brick(medium, brick);
      medium_ = medium;
      brick_ = brick;
    }
    return *held_;
  }

 private:
  Resolver* resolver_;
  const Brick* held_ = nullptr;
  int medium_ = -1;
  int brick_ = -1;
};

class SmokeGrid {
 public:
  SmokeGrid() = default;

  /// Errors: sizes, array lengths or values that break medium.hpp's rules.
  static Result<SmokeGrid> make(const Medium& medium, int medium_index,
                                const glm::dvec3& local_origin);
  /// Takes over which bricks are clear, wherever the arrays are. `emits`: the medium has emission.
  /// Requires: a table of brick_count() bricks.
  void settle(const BrickTable& table, bool emits);

  int medium() const { return medium_; }
  const glm::ivec3& cells() const { return cells_; }
  const glm::ivec3& bricks() const { return bricks_; }
  int brick_count() const { return bricks_.x * bricks_.y * bricks_.z; }
  double cell_volume_m3() const { return cell_.x * cell_.y * cell_.z; }
  double volume_m3() const { return extent_.x * extent_.y * extent_.z; }
  bool has_extinction() const { return has_extinction_; }
  bool has_albedo() const { return has_albedo_; }
  bool has_emission() const { return has_emission_; }
  bool interpolates_emission() const { return interpolate_emission_; }
  /// Whether no cell of the brick has extinction or emission.
  bool clear(int brick) const { return clear_[static_cast<size_t>(brick)] != 0; }

  int brick_of(const glm::ivec3& cell) const {
    constexpr int side = limits::brick_side;
    return ((cell.z / side) * bricks_.y + cell.y / side) * bricks_.x + cell.x / side;
  }
  glm::dvec3 to_local(const glm::dvec3& p) const { return (p - origin_) * axes_; }
  glm::dvec3 to_local_direction(const glm::dvec3& d) const { return d * axes_; }
  glm::dvec3 from_local(const glm::dvec3& p) const { return origin_ + axes_ * p; }
  const glm::dvec3& extent() const { return extent_; }
  const glm::dvec3& cell_size() const { return cell_; }
  const glm::dvec3& cells_per_m() const { return per_cell_; }

  bool contains_local(const glm::dvec3& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < extent_.x && p.y < extent_.y &&
           p.z < extent_.z;
  }
  glm::ivec3 cell_at(const glm::dvec3& local) const {
    glm::ivec3 cell;
    for (int k = 0; k < 3; ++k) {
      cell[k] = std::clamp(static_cast<int>(local[k] * per_cell_[k]), 0, cells_[k] - 1);
    }
    return cell;
  }
  /// A box in the tracer's coordinates that holds the grid.
  Bounds bounds() const;

 private:
  int medium_ = -1;
  glm::dvec3 origin_{0};
  glm::dmat3 axes_{1.0};
  glm::dvec3 extent_{0};
  glm::dvec3 cell_{0};      // size of a cell [m]
  glm::dvec3 per_cell_{0};  // its inverse
  glm::ivec3 cells_{0};
  glm::ivec3 bricks_{0};
  bool has_extinction_ = false;
  bool has_albedo_ = false;
  bool has_emission_ = false;
  bool interpolate_emission_ = false;
  std::vector<uint8_t> clear_;  // by brick: rays may skip it
};

/// Walks a ray through a grid: one segment per cell, one per clear brick. Faces are crossed by
/// integer index, and each face's distance is computed from the ray's origin, so the segments tile
/// the part of the ray in the box without gaps; there are at most nx + ny + nz of them.
class GridCursor {
 public:
  /// False if the ray misses the grid within `within`.
  bool begin(const SmokeGrid& grid, const glm::dvec3& o, const glm::dvec3& d, RayInterval within) {
    grid_ = &grid;
    o_ = grid.to_local(o);
    d_ = grid.to_local_direction(d);
    const RayInterval box = inside_box(glm::dvec3(0), grid.extent(), o_, d_, within);
    if (box.empty()) return false;
    t_in_ = box.t0;
    t_out_ = box.t1;
    state_ = State::before;
    clear_ = false;
    t_end_ = t_in_;
    return true;
  }

  const SmokeGrid& grid() const { return *grid_; }
  bool inside() const { return state_ == State::inside; }
  /// The end of the present segment; infinity behind the grid.
  double t_end() const { return t_end_; }
  const glm::ivec3& cell() const { return cell_; }
  /// Whether the present segment is a whole brick without extinction or emission.
  bool clear() const { return clear_; }
  glm::dvec3 local_at(double t) const { return o_ + d_ * t; }

  /// Advances to the next segment. Requires: t_end() is finite.
  void advance() {
    if (state_ == State::before) {
      cell_ = grid_->cell_at(local_at(t_in_));
      for (int k = 0; k < 3; ++k) {
        step_[k] = d_[k] > 0 ? 1 : -1;
        inverse_[k] = 1 / d_[k];
      }
      state_ = State::inside;
      set_end();
      return;
    }
    if (t_end_ >= t_out_) return leave();
    const double t = t_end_;
    const int k = axis_;
    if (clear_) {
      const glm::dvec3 p = local_at(t);
      const glm::ivec3 reached = grid_->cell_at(p);
      for (int j = 0; j < 3; ++j) {
        if (j == k) continue;
        // Clamped to the brick being left, and never backwards.
        const int low = cell_[j] & ~(limits::brick_side - 1);
        const int high = std::min(low + limits::brick_side, grid_->cells()[j]) - 1;
        const int c = std::clamp(reached[j], low, high);
        cell_[j] = step_[j] > 0 ? std::max(cell_[j], c) : std::min(cell_[j], c);
      }
    }
    cell_[k] = step_[k] > 0 ? plane_ : plane_ - 1;
    if (cell_[k] < 0 || cell_[k] >= grid_->cells()[k]) return leave();
    set_end();
  }

 private:
  enum class State : uint8_t { before, inside, behind };

  void leave() {
    state_ = State::behind;
    t_end_ = std::numeric_limits<double>::infinity();
  }

  void set_end() {
    clear_ = grid_->clear(grid_->brick_of(cell_));
    t_end_ = t_out_;
    for (int k = 0; k < 3; ++k) {
      if (d_[k] == 0) continue;
      int plane = cell_[k] + (step_[k] > 0 ? 1 : 0);
      if (clear_) {
        const int low = cell_[k] & ~(limits::brick_side - 1);
        plane = step_[k] > 0 ? std::min(low + limits::brick_side, grid_->cells()[k]) : low;
      }
      const double t = (plane * grid_->cell_size()[k] - o_[k]) * inverse_[k];
      if (t < t_end_) {
        t_end_ = t;
        axis_ = k;
        plane_ = plane;
      }
    }
  }

  // Not initialised: every flight makes arrays of cursors, and begin() sets what is read.
  const SmokeGrid* grid_;
  glm::dvec3 o_;
  glm::dvec3 d_;
  glm::dvec3 inverse_;
  double t_in_;
  double t_out_;
  double t_end_;
  glm::ivec3 cell_;
  glm::ivec3 step_;
  int axis_;
  int plane_;
  State state_;
  bool clear_;
};

}  // namespace luxodus
