// Cells of a scene's space, for each of which data is computed at its first use. The data must
// follow from the cell alone: then it does not depend on who uses it first, and two threads that
// compute the same cell at once get equal results. Any thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Edge of a cell [m], and as a share of the diagonal for small scenes; rooms and spacings of
/// luminaires are larger.
inline constexpr Real max_learned_edge_m = 1;
inline constexpr Real learned_edge_share = 1.0_r / 32;
/// Largest number of cells; larger scenes get larger cells.
inline constexpr int64_t learned_cells = 1 << 20;
}  // namespace limits

/// Cubes of one size that fill a scene.
class CellGrid {
 public:
  /// At most `most` cells, at least one.
  CellGrid(const CompiledScene& scene, int64_t most) : low_(scene.local_low) {
    const glm::dvec3 size = glm::max(glm::dvec3(scene.local_high) - glm::dvec3(low_), 0.0);
    edge_ = limits::max_learned_edge_m;  // also if everything in the scene is at one point
    if (scene.diagonal_m > 0)
      edge_ = std::min(edge_, limits::learned_edge_share * scene.diagonal_m);
    // In floating point: a country has more cells of 1 m than integers can count.
    glm::dvec3 counts;
    const auto limit = static_cast<double>(std::max<int64_t>(most, 1));
    for (;; edge_ *= 1.25_r) {
      counts = glm::floor(size / static_cast<double>(edge_)) + 1.0;
      if (counts.x * counts.y * counts.z <= limit) break;
    }
    nx_ = static_cast<int64_t>(counts.x);
    ny_ = static_cast<int64_t>(counts.y);
    nz_ = static_cast<int64_t>(counts.z);
  }

  size_t count() const { return static_cast<size_t>(nx_ * ny_ * nz_); }
  Real edge() const { return edge_; }
  /// The lower corner of a cell.
  Vec3 low_of(size_t cell) const {
    const auto i = static_cast<int64_t>(cell);
    return low_ + edge_ * Vec3(static_cast<Real>(i % nx_), static_cast<Real>(i / nx_ % ny_),
                               static_cast<Real>(i / nx_ / ny_));
  }
  /// The cell of a place, or the nearest one.
  size_t cell_of(const Vec3& place) const {
    const auto along = [&](Real at, int64_t count) {
      const Real last = static_cast<Real>(count - 1);
      return static_cast<int64_t>(std::clamp(at / edge_, 0.0_r, last));
    };
    const Vec3 p = place - low_;
    return static_cast<size_t>((along(p.z, nz_) * ny_ + along(p.y, ny_)) * nx_ + along(p.x, nx_));
  }

 private:
  Vec3 low_;
  Real edge_;
  int64_t nx_ = 1, ny_ = 1, nz_ = 1;
};

template <class Learned>
class LearnedCells {
 public:
  /// `sides`: number of separate entries per cell.
  LearnedCells(const CellGrid& grid, size_t sides)
      : grid_(grid),
        sides_(sides),
        learned_(std::make_unique<std::atomic<const Learned*>[]>(grid.count() * sides)) {}
  ~LearnedCells() {
    for (size_t i = 0; i < grid_.count() * sides_; ++i) delete learned_[i].load();
  }
  LearnedCells(const LearnedCells&) = delete;
  LearnedCells& operator=(const LearnedCells&) = delete;

  const CellGrid& grid() const { return grid_; }

  /// The data for a side of a place's cell, or of the nearest one. `learn(cell)` computes it.
  template <class Learn>
  const Learned& at(const Vec3& place, size_t side, Learn&& learn) const {
    const size_t cell = grid_.cell_of(place);
    std::atomic<const Learned*>& learned = learned_[cell * sides_ + side];
    if (const Learned* known = learned.load(std::memory_order_acquire)) return *known;
    auto own = std::make_unique<const Learned>(learn(cell));
    const Learned* faster = nullptr;
    if (!learned.compare_exchange_strong(faster, own.get(), std::memory_order_acq_rel))
      return *faster;
    return *own.release();
  }

 private:
  CellGrid grid_;
  size_t sides_;
  std::unique_ptr<std::atomic<const Learned*>[]> learned_;  // by cell and side
};

}  // namespace luxodus
