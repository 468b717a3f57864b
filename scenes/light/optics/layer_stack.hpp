// Horizontal slabs that fill all space: the union of all homogeneous and layered media of a scene
// without footprint. Each slab knows the sum of the extinctions in it and its components. The
// lowest slab is unbounded below, the highest above.
//
// Free-flight sampling inverts the optical depth along a ray exactly. The distance to each slab's
// exit is computed from the geometry, not from the optical depth, so that nearly horizontal rays
// lose no precision. Slabs are visited one by one; in tall stacks they are skipped by means of the
// cumulative optical depth. Slabs are half-open, low <= z < high: a ray along a boundary is in the
// slab above it. Immutable once made; any thread.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "scenes/light/optics/ray_interval.hpp"

namespace luxodus {

namespace limits {
/// Layers of all media without polygon. A stack from FDS results has some 100. Compiling visits
/// every layer for every slab (some 10 ms at this limit, a second at 10x).
inline constexpr int max_layers = 2048;
/// Stacks up to this size are visited slab by slab; above it, skipping by bisection is faster
/// (measured: break-even between 10 and 20).
inline constexpr int slabs_walked = 16;
}  // namespace limits

class LayerStack {
 public:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// One component between two heights [m]; -infinity and infinity are allowed.
  struct Part {
    double z_low;
    double z_high;
    int component;
  };

  /// `sigma_t[band * components + c]` is the extinction [1/m] of component c.
  void build(const std::vector<Part>& parts, const std::vector<double>& sigma_t, int components,
             int bands);

  int slabs() const { return slabs_; }
  /// Whether no slab absorbs or scatters.
  bool empty() const { return members_.empty(); }

  int slab_at(double z) const;
  double z_low(int slab) const { return bounds_[static_cast<size_t>(slab)]; }
  double z_high(int slab) const { return bounds_[static_cast<size_t>(slab) + 1]; }
  double sigma_t(int band, int slab) const { return row(sum_, band)[slab]; }
  /// Components present in a slab.
  std::span<const int> members(int slab) const {
    const auto i = static_cast<size_t>(slab);
    return {members_.data() + first_[i], members_.data() + first_[i + 1]};
  }

  struct Stop {
    double t = 0;
    int slab = -1;  // -1: t_max was reached first
  };
  /// The point at which optical depth `tau` is reached on a ray from height z0 that rises dz per
  /// length. Requires: tau >= 0, t_max >= 0 (infinity allowed).
  Stop fly(int band, double z0, double dz, double t_max, double tau) const;
  /// Optical depth up to t_max.
  double depth(int band, double z0, double dz, double t_max) const;

 private:
  const double* row(const std::vector<double>& table, int band) const {
    return table.data() + static_cast<size_t>(band) * static_cast<size_t>(slabs_);
  }
  int skip(const double* running, int slab, double z0, double dz, double t_max, double tau) const;

  int slabs_ = 1;
  std::vector<double> bounds_{-infinity, infinity};  // slabs + 1 heights, ends infinite
  std::vector<double> sum_{0.0};                     // [band][slab], 1/m
  std::vector<double> running_{
      0.0};  // [band][slab]: optical depth from the lowest boundary to z_low
  std::vector<size_t> first_{0, 0};
  std::vector<int> members_;
};

inline int LayerStack::slab_at(double z) const {
  const int inner = slabs() - 1;  // boundaries between slabs
  const double* bound = bounds_.data() + 1;
  if (inner > limits::slabs_walked) {
    return static_cast<int>(std::upper_bound(bound, bound + inner, z) - bound);
  }
  int slab = 0;
  for (int i = 0; i < inner; ++i) slab += z >= bound[i] ? 1 : 0;  // no branch to mispredict
  return slab;
}

inline LayerStack::Stop LayerStack::fly(int band, double z0, double dz, double t_max,
                                        double tau) const {
  int slab = slab_at(z0);
  const double* sigma = row(sum_, band);
  if (dz == 0) {  // stays in its slab
    const double t = tau / sigma[slab];
    return t < t_max ? Stop{t, slab} : Stop{t_max, -1};
  }
  const double inverse = 1 / dz;
  const int step = dz > 0 ? 1 : -1;
  const double* exit = bounds_.data() + (dz > 0 ? 1 : 0);
  double t = 0;
  for (bool entered = false;; entered = true) {
    if (entered && slabs() > limits::slabs_walked) {
      const double* running = row(running_, band);
      const int ahead = skip(running, slab, z0, dz, t_max, tau);
      if (ahead != slab) {
        const int from = slab + (dz > 0 ? 0 : 1);
        const int to = ahead + (dz > 0 ? 0 : 1);
        tau = std::max(0.0, tau - (running[to] - running[from]) * inverse);
        t = (bounds_[static_cast<size_t>(to)] - z0) * inverse;
        slab = ahead;
      }
    }
    // Each exit is computed from the origin, so that errors do not accumulate.
    const double t_exit = std::min((exit[slab] - z0) * inverse, t_max);
    const double here = sigma[slab] * (t_exit - t);
    if (tau < here) return {t + tau / sigma[slab], slab};
    if (t_exit >= t_max) return {t_max, -1};
    tau -= here;
    t = t_exit;
    slab += step;
  }
}

inline double LayerStack::depth(int band, double z0, double dz, double t_max) const {
  int slab = slab_at(z0);
  const double* sigma = row(sum_, band);
  if (dz == 0) return sigma[slab] > 0 ? sigma[slab] * t_max : 0;
  const double inverse = 1 / dz;
  const int step = dz > 0 ? 1 : -1;
  const double* exit = bounds_.data() + (dz > 0 ? 1 : 0);
  double t = 0;
  double tau = 0;
  for (;;) {
    const double t_exit = std::min((exit[slab] - z0) * inverse, t_max);
    if (sigma[slab] > 0) tau += sigma[slab] * (t_exit - t);  // 0 times infinity is NaN
    if (t_exit >= t_max) return tau;
    t = t_exit;
    slab += step;
  }
}

}  // namespace luxodus
