// Cells of a scene's space, of each of which something is learned when somebody first asks. What is
// learned must follow from the cell alone: then it is the same whoever asks first, and two who
// learn the same cell at once agree. Any thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>

#include "scenes/geometry/real.hpp"
#include "scenes/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Edge of a cell [m], and as a share of the diagonal of small scenes: rooms and the distances of
/// luminaires are larger.
inline constexpr Real max_learned_edge_m = 1;
inline constexpr Real learned_edge_share = 1.0_r / 32;
/// Large scenes have larger cells.
inline constexpr int64_t learned_cells = 1 << 20;
}  // namespace limits

template <class Learned>
class LearnedCells {
 public:
  explicit LearnedCells(const CompiledScene& scene) : low_(scene.local_low) {
    const Vec3 size = scene.local_high - scene.local_low;
    edge_ = std::min(limits::max_learned_edge_m, limits::learned_edge_share * scene.diagonal_m);
    for (;; edge_ *= 1.25_r) {
      nx_ = static_cast<int64_t>(size.x / edge_) + 1;
      ny_ = static_cast<int64_t>(size.y / edge_) + 1;
      nz_ = static_cast<int64_t>(size.z / edge_) + 1;
      if (nx_ * ny_ * nz_ <= limits::learned_cells) break;
    }
    cells_ = std::make_unique<std::atomic<const Learned*>[]>(count());
  }
  ~LearnedCells() {
    for (size_t i = 0; i < count(); ++i) delete cells_[i].load();
  }
  LearnedCells(const LearnedCells&) = delete;
  LearnedCells& operator=(const LearnedCells&) = delete;

  size_t count() const { return static_cast<size_t>(nx_ * ny_ * nz_); }
  Real edge() const { return edge_; }
  /// The corner of a cell of the least coordinates.
  Vec3 low_of(size_t cell) const {
    const auto i = static_cast<int64_t>(cell);
    return low_ + edge_ * Vec3(static_cast<Real>(i % nx_), static_cast<Real>(i / nx_ % ny_),
                               static_cast<Real>(i / nx_ / ny_));
  }

  /// Of the cell of a place, or of the nearest one. `learn(cell)` makes it.
  template <class Learn>
  const Learned& at(const Vec3& place, Learn&& learn) const {
    const size_t cell = cell_of(place);
    if (const Learned* known = cells_[cell].load(std::memory_order_acquire)) return *known;
    auto own = std::make_unique<const Learned>(learn(cell));
    const Learned* faster = nullptr;
    if (!cells_[cell].compare_exchange_strong(faster, own.get(), std::memory_order_acq_rel))
      return *faster;
    return *own.release();
  }

 private:
  size_t cell_of(const Vec3& place) const {
    const auto along = [&](Real at, int64_t count) {
      const Real last = static_cast<Real>(count - 1);
      return static_cast<int64_t>(std::clamp(at / edge_, 0.0_r, last));
    };
    const Vec3 p = place - low_;
    return static_cast<size_t>((along(p.z, nz_) * ny_ + along(p.y, ny_)) * nx_ + along(p.x, nx_));
  }

  Vec3 low_;
  Real edge_ = 1;
  int64_t nx_ = 1, ny_ = 1, nz_ = 1;
  std::unique_ptr<std::atomic<const Learned*>[]> cells_;
};

}  // namespace luxodus
