// Phase functions compiled for tracing. Sampling is exact inversion in float, stable for every |g|
// <= 1; evaluate is the density of the same function [1/sr], normalised over the sphere. Angles are
// between the directions of travel before and after: cos_theta = 1 is forward. Not here: how much
// is scattered (albedo, sigma_t; see media_set.hpp). Immutable once made; any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/medium.hpp"
#include "scenes/light/optics/sampling.hpp"

namespace luxodus {

namespace phase_limits {
/// Entries of a tabulated phase function: Mie tables have some thousand; ten times as many would no
/// longer fit the first-level cache.
inline constexpr std::size_t max_table_entries = 4096;
/// If |g| is closer to 1 than this, it is taken as 1 (scattering without deflection): the cube in
/// the density of the peak, 1 / (2 pi (1 - g)^2), would leave the range of float.
inline constexpr double min_one_minus_g = 1e-9;
}  // namespace phase_limits

class PhaseFunction {
 public:
  /// Isotropic.
  PhaseFunction() = default;

  /// Errors: |g| > 1 or not finite; a table of fewer than 2 or too many entries, of different
  /// lengths, not ascending from -1 to 1, with a value below 0 or not finite, or without any
  /// scattering.
  static Result<PhaseFunction> make(const Phase& phase, const SourcePlace& where);

  /// A scattering angle. cos is in [-1, 1]; sin has its own relative accuracy, so that a narrow
  /// peak keeps its shape where cos rounds to 1 in float.
  struct Deflection {
    Real cos;
    Real sin;
  };
  /// The angle for u in [0, 1), by inverting the distribution function.
  Deflection deflection(Real u) const;

  PhaseKind kind() const { return kind_; }
  /// Mean cosine of the scattering angle, for the function as it is sampled.
  Real mean_cosine() const { return mean_cosine_; }
  /// Mean of the second Legendre polynomial of that cosine, (3 cos^2 - 1) / 2.
  Real mean_second() const { return mean_second_; }
  std::size_t bytes() const { return sizeof(*this) + table_.capacity() * sizeof(Node); }

 private:
  friend Real evaluate(const PhaseFunction& phase, Real cos_theta);
  friend Real evaluate_spread(const PhaseFunction& phase, Real cos_theta, Real mean_cosine);
  friend Real evaluate_spread(const PhaseFunction& phase, Real cos_theta, Real mean_cosine,
                              Real mean_second);

  /// One node of the piecewise linear density. Stored as 1 - cos, descending, so that a forward
  /// peak keeps its width; `below` is the probability of a smaller cosine.
  struct Node {
    Real one_minus_cos;
    Real density;  // per unit of cosine: 2 pi x density per solid angle
    Real below;
  };

  Deflection henyey_greenstein(Real u) const;
  static Deflection rayleigh(Real u);
  Deflection tabulated(Real u) const;
  static Real henyey_greenstein_density(Real cos_theta, Real g, Real one_minus_g);
  Real tabulated_density(Real cos_theta) const;
  void compile_table(const Phase& phase);

  PhaseKind kind_ = PhaseKind::isotropic;
  Real sign_ = 1;         // of g: a negative g is the mirrored function of |g|
  Real g_ = 0;            // |g|
  Real one_minus_g_ = 1;  // 1 - |g|, rounded once from double
  Real mean_cosine_ = 0, mean_second_ = 0;
  std::vector<Node> table_;  // tabulated: at least two
};

/// Henyey and Greenstein (1941) inverted without a division by g and without cancellation. With p =
/// 2 u, q = 2 (1 - u), d = (1 - g) + g p:
///   1 - cos = (1 - g)^2 q (2 + g p) / (2 d^2),   1 + cos = (1 + g)^2 p (2 (1 - g) + g p) / (2
///   d^2),
/// sums of positive terms only for g in [0, 1], so both keep their relative accuracy at any g; g =
/// 0 gives q and p. (Put s = 2 u - 1 into the textbook form and factor (1 - g^2) out.)
inline PhaseFunction::Deflection PhaseFunction::henyey_greenstein(Real u) const {
  const Real p = 2.0_r * u;
  const Real q = 2.0_r * (1.0_r - u);
  const Real d = one_minus_g_ + g_ * p;
  if (d == 0.0_r) return {sign_, 0.0_r};  // |g| = 1 and u = 0: as for any u at |g| = 1
  const Real inverse = 1.0_r / d;
  const Real ratio = one_minus_g_ * inverse;
  const Real ratio_plus = (1.0_r + g_) * inverse;
  const Real one_minus_cos = 0.5_r * ratio * ratio * q * (2.0_r + g_ * p);
  const Real one_plus_cos = 0.5_r * ratio_plus * ratio_plus * p * (2.0_r * one_minus_g_ + g_ * p);
  const Real cos = choose(one_minus_cos < 1.0_r, 1.0_r - one_minus_cos, one_plus_cos - 1.0_r);
  return {sign_ * cos, std::sqrt(one_minus_cos * one_plus_cos)};
}

/// Rayleigh: u = (c^3 + 3 c + 4) / 8, solved for c by Newton from a quintic that errs by at most
/// 3e-3. The slope is 3 (c^2 + 1) >= 3, so two steps end at rounding everywhere.
inline PhaseFunction::Deflection PhaseFunction::rayleigh(Real u) {
  const Real k = 8.0_r * u - 4.0_r;
  const Real square = k * k;
  Real c = k * (0.333333333_r + square * (-0.0100296_r + square * 0.00030133_r));
  for (int step = 0; step < 2; ++step) {
    c -= (c * (c * c + 3.0_r) - k) / (3.0_r * (c * c + 1.0_r));
  }
  c = std::clamp(c, -1.0_r, 1.0_r);
  return {c, std::sqrt((1.0_r - c) * (1.0_r + c))};
}

inline PhaseFunction::Deflection PhaseFunction::deflection(Real u) const {
  switch (kind_) {
    case PhaseKind::isotropic:
      return {1.0_r - 2.0_r * u, 2.0_r * std::sqrt(u * (1.0_r - u))};
    case PhaseKind::rayleigh:
      return rayleigh(u);
    case PhaseKind::tabulated:
      return tabulated(u);
    case PhaseKind::henyey_greenstein:
      break;
  }
  return henyey_greenstein(u);
}

/// Direction of travel [unit] after scattering; u, v in [0, 1).
/// Requires: direction_of_travel is unit.
inline Vec3 sample(const PhaseFunction& phase, const Vec3& direction_of_travel, Real u, Real v) {
  if (phase.kind() == PhaseKind::isotropic) return uniform_sphere(u, v);
  const PhaseFunction::Deflection angle = phase.deflection(u);
  const SinCos phi = sin_cos_two_pi(v);
  return to_world(direction_of_travel, {angle.sin * phi.cos, angle.sin * phi.sin, angle.cos});
}

/// (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)), with 1 + g^2 - 2 g cos = (1 - g)^2 + 2 g (1 -
/// cos). 0 for |g| = 1, a delta distribution that no evaluation hits.
inline Real PhaseFunction::henyey_greenstein_density(Real cos_theta, Real g, Real one_minus_g) {
  const Real one_minus_cos = std::max(0.0_r, 1.0_r - cos_theta);
  const Real square = one_minus_g * one_minus_g + 2.0_r * g * one_minus_cos;
  if (one_minus_g == 0.0_r) return 0.0_r;
  return 0.25_r * inverse_pi_f * one_minus_g * (1.0_r + g) / (square * std::sqrt(square));
}

/// Density [1/sr] of scattering by an angle with this cosine.
inline Real evaluate(const PhaseFunction& phase, Real cos_theta) {
  switch (phase.kind_) {
    case PhaseKind::isotropic:
      return 0.25_r * inverse_pi_f;
    case PhaseKind::rayleigh:
      return 0.1875_r * inverse_pi_f * (1.0_r + cos_theta * cos_theta);
    case PhaseKind::tabulated:
      return phase.tabulated_density(cos_theta);
    case PhaseKind::henyey_greenstein:
      break;
  }
  return PhaseFunction::henyey_greenstein_density(phase.sign_ * cos_theta, phase.g_,
                                                  phase.one_minus_g_);
}

/// Density [1/sr] with which light that arrives from many directions is scattered into one
/// direction. `mean_cosine` in [0, 1] is the mean cosine of the arriving directions to their mean
/// direction; `cos_theta` is the cosine of the outgoing direction to it. The light is modelled as
/// spread by a Henyey-Greenstein law, which scattering by such a law preserves (mean cosines
/// multiply). Exact for a beam (1) and for isotropic light (0).
inline Real evaluate_spread(const PhaseFunction& phase, Real cos_theta, Real mean_cosine) {
  constexpr Real even = 0.25_r * inverse_pi_f;
  switch (phase.kind_) {
    case PhaseKind::isotropic:
      return even;
    case PhaseKind::rayleigh:
    case PhaseKind::tabulated:  // as a mixture of a beam and isotropic light
      return mean_cosine * evaluate(phase, cos_theta) + (1 - mean_cosine) * even;
    case PhaseKind::henyey_greenstein:
      break;
  }
  const Real one_minus_g = phase.one_minus_g_ + phase.g_ * (1 - mean_cosine);
  return PhaseFunction::henyey_greenstein_density(phase.sign_ * cos_theta, phase.g_ * mean_cosine,
                                                  one_minus_g);
}

/// Variant for light whose second moment is known, too: `mean_second` is the mean of (3 cos^2 - 1)
/// / 2 of the angles to the outgoing direction. Never negative.
inline Real evaluate_spread(const PhaseFunction& phase, Real cos_theta, Real mean_cosine,
                            Real mean_second) {
  const bool by_law = phase.kind_ == PhaseKind::henyey_greenstein;
  const Real of_spread = by_law ? mean_cosine * mean_cosine : mean_cosine;
  const Real off = mean_second - of_spread * (1.5_r * cos_theta * cos_theta - 0.5_r);
  return std::max(0.0_r, evaluate_spread(phase, cos_theta, mean_cosine) +
                             1.25_r * inverse_pi_f * phase.mean_second_ * off);
}

}  // namespace luxodus
