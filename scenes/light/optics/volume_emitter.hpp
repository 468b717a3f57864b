// Emission of a glowing body (a flame): samples points in proportion to emission per volume, and
// evaluates that emission as a density that integrates to 1 over the body. Power and bands are the
// caller's. Bodies glow uniformly; data sets by their cells' strength, constant in a cell or
// interpolated between cell centres (constant beyond the outermost centres). Immutable once made;
// any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/quadric_body.hpp"
#include "scenes/light/optics/smoke_grid.hpp"

namespace luxodus {

class VolumeEmitter {
 public:
  VolumeEmitter(int medium, QuadricBody body) : medium_(medium), body_(std::move(body)) {}
  /// Requires: settle() of `grid` was called with this table.
  VolumeEmitter(SmokeGrid grid, const BrickTable& table);

  int medium() const { return medium_; }
  double volume_m3() const { return body_ ? body_->volume().m3 : grid_.volume_m3(); }
  /// False if nothing glows: every cell's strength is 0.
  bool glows() const { return body_ || !grid_.has_emission() || total_ > 0; }

  /// Samples a point in the tracer's coordinates. `next_uniform()` returns independent numbers in
  /// [0, 1); a data set takes four, a body three per try.
  template <class Uniform, class Resolver>
  Vec3 sample(Uniform&& next_uniform, Resolver& resolver) const;

  /// Emission per volume [1/m3], integral 1, at a point in the tracer's coordinates.
  template <class Resolver>
  double density(const glm::dvec3& p, BrickReader<Resolver>& bricks) const;

  /// Mean of the density over the cursor's segment from t0 to t1, exact (Simpson's rule on pieces
  /// where the interpolation is a cubic along the ray). Requires: made from a grid; t1 > t0 within
  /// one cell.
  template <class Resolver>
  double mean_density(const GridCursor& cursor, double t0, double t1,
                      BrickReader<Resolver>& bricks) const;

 private:
  template <class Resolver>
  glm::ivec3 choose_cell(double u, BrickReader<Resolver>& bricks) const;
  template <class Resolver>
  double strength(const glm::ivec3& cell, BrickReader<Resolver>& bricks) const;
  template <class Resolver>
  double local_density(const glm::dvec3& local, BrickReader<Resolver>& bricks) const;

  int medium_;
  std::optional<QuadricBody> body_;
  SmokeGrid grid_;
  std::vector<double> brick_cumulative_;  // running sum of strengths
  double total_ = 0;                      // sum of all strengths
};

/// Offset from the centre of a cell, in cells, drawn from a tent function over two cells: linear
/// interpolation between centres is a sum of such tents.
inline double tent_offset(double u) {
  return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u));
}

template <class Resolver>
double VolumeEmitter::strength(const glm::ivec3& cell, BrickReader<Resolver>& bricks) const {
  const Brick& brick = bricks.at(medium_, grid_.brick_of(cell));
  return static_cast<double>(brick.emission[static_cast<size_t>(Brick::cell_index(cell))]);
}

template <class Resolver>
glm::ivec3 VolumeEmitter::choose_cell(double u, BrickReader<Resolver>& bricks) const {
  const auto reached = [](const std::vector<double>& running, double value) {
    const auto it = std::upper_bound(running.begin(), running.end(), value);
    // Rounding may carry the value to the end: then the last entry that adds something is used.
    return static_cast<size_t>(
        (it != running.end() ? it
                             : std::lower_bound(running.begin(), running.end(), running.back())) -
        running.begin());
  };
  const double value = u * total_;
  const size_t b = reached(brick_cumulative_, value);
  const double within = value - (b > 0 ? brick_cumulative_[b - 1] : 0.0);
  const auto brick = static_cast<int>(b);
  const auto c = static_cast<int>(reached(bricks.at(medium_, brick).emission_cumulative, within));
  constexpr int side = limits::brick_side;
  const glm::ivec3 n = grid_.bricks();
  const glm::ivec3 corner(brick % n.x, brick / n.x % n.y, brick / (n.x * n.y));
  return corner * side + glm::ivec3(c % side, c / side % side, c / (side * side));
}

template <class Uniform, class Resolver>
Vec3 VolumeEmitter::sample(Uniform&& next_uniform, Resolver& resolver) const {
  if (body_) return Vec3(body_->sample(next_uniform));
  const double choice = next_uniform();
  const double u = next_uniform();
  const double v = next_uniform();
  const double w = next_uniform();
  const glm::dvec3 draw(u, v, w);
  if (!grid_.has_emission()) return Vec3(grid_.from_local(draw * grid_.extent()));
  BrickReader<Resolver> bricks(resolver);
  const glm::ivec3 cell = choose_cell(choice, bricks);
  glm::dvec3 place = glm::dvec3(cell) + draw;
  if (grid_.interpolates_emission()) {
    for (int k = 0; k < 3; ++k) {
      place[k] = cell[k] + 0.5 + tent_offset(draw[k]);
      // The tent is folded at the wall, so that the density is constant from the outermost centre
      // to it.
      if (place[k] < 0) place[k] = -place[k];
      if (place[k] > grid_.cells()[k]) place[k] = 2 * grid_.cells()[k] - place[k];
    }
  }
  return Vec3(grid_.from_local(place * grid_.cell_size()));
}

template <class Resolver>
double VolumeEmitter::local_density(const glm::dvec3& local, BrickReader<Resolver>& bricks) const {
  if (!grid_.has_emission()) return 1 / grid_.volume_m3();
  const double per_strength = 1 / (total_ * grid_.cell_volume_m3());
  if (!grid_.interpolates_emission()) return strength(grid_.cell_at(local), bricks) * per_strength;
  glm::ivec3 base;
  glm::dvec3 share;
  for (int k = 0; k < 3; ++k) {
    const double g = std::clamp(local[k] * grid_.cells_per_m()[k] - 0.5, 0.0,
                                static_cast<double>(grid_.cells()[k] - 1));
    base[k] = static_cast<int>(g);
    share[k] = g - base[k];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    glm::ivec3 cell = base;
    for (int k = 0; k < 3; ++k) {
      const bool far = ((corner >> k) & 1) != 0;
      weight *= far ? share[k] : 1 - share[k];
      if (far) cell[k] = std::min(cell[k] + 1, grid_.cells()[k] - 1);
    }
    if (weight > 0) sum += weight * strength(cell, bricks);
  }
  return sum * per_strength;
}

template <class Resolver>
double VolumeEmitter::density(const glm::dvec3& p, BrickReader<Resolver>& bricks) const {
  if (body_) return body_->contains(p) ? 1 / body_->volume().m3 : 0;
  const glm::dvec3 local = grid_.to_local(p);
  return grid_.contains_local(local) ? local_density(local, bricks) : 0;
}

template <class Resolver>
double VolumeEmitter::mean_density(const GridCursor& cursor, double t0, double t1,
                                   BrickReader<Resolver>& bricks) const {
  if (!grid_.has_emission()) return 1 / grid_.volume_m3();
  if (!grid_.interpolates_emission()) {
    return strength(cursor.cell(), bricks) / (total_ * grid_.cell_volume_m3());
  }
  // The interpolating cubic changes where the ray passes the cell's middle in x, y or z.
  double cut[5] = {t0, 0, 0, 0, 0};
  int n = 1;
  const glm::dvec3 start = cursor.local_at(t0);
  const glm::dvec3 way = cursor.local_at(t1) - start;
  for (int k = 0; k < 3; ++k) {
    const double centre = (cursor.cell()[k] + 0.5) * grid_.cell_size()[k];
    const double share = (centre - start[k]) / way[k];
    if (!(share > 0 && share < 1)) continue;
    const double t = t0 + share * (t1 - t0);
    int place = n++;
    for (; place > 1 && cut[place - 1] > t; --place) cut[place] = cut[place - 1];
    cut[place] = t;
  }
  cut[n++] = t1;
  double sum = 0;
  double before = local_density(cursor.local_at(t0), bricks);
  for (int i = 1; i < n; ++i) {
    const double half = local_density(cursor.local_at(0.5 * (cut[i - 1] + cut[i])), bricks);
    const double after = local_density(cursor.local_at(cut[i]), bricks);
    sum += (cut[i] - cut[i - 1]) * (before + 4 * half + after) / 6;
    before = after;
  }
  return sum / (t1 - t0);
}

}  // namespace luxodus
