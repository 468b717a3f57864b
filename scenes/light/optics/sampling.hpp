// Directions and points from uniform numbers: small functions of the tracer's innermost loop.
// Promise: equal bits on any thread and any node of one instruction set, because only +, -, *, /,
// sqrt and bit patterns are used (all rounded by IEEE 754) and never the C library's elementary
// functions. u and v are in [0, 1), multiples of 2^-24; a direction is unit to 3e-7. Local frames
// have z as their axis. Not here: random numbers, and densities that depend on a scene. Pure
// functions; any thread.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

inline constexpr Real pi_f = static_cast<Real>(std::numbers::pi_v<long double>);
inline constexpr Real inverse_pi_f = static_cast<Real>(std::numbers::inv_pi_v<long double>);

/// `condition ? a : b` without a branch: on random conditions a mispredicted one costs more than
/// both sides.
inline float choose(bool condition, float a, float b) {
  const uint32_t mask = 0U - static_cast<uint32_t>(condition);
  return std::bit_cast<float>((std::bit_cast<uint32_t>(a) & mask) |
                              (std::bit_cast<uint32_t>(b) & ~mask));
}
inline double choose(bool condition, double a, double b) {
  return condition ? a : b;
}

// ---- elementary functions ----------------------------------------------------------------------
// Polynomials interpolate at the Chebyshev nodes of their range (coefficients computed in double).

// The double forms are the C library's: there accuracy matters, not reproducible bits or speed.

template <class T>
struct SinCosOf {
  T sin;
  T cos;
};
using SinCos = SinCosOf<Real>;

/// sin and cos of 2 pi u for u in [0, 1]. Absolute error at most 1.2e-7 (tested on all 2^24 + 1
/// inputs).
inline SinCosOf<float> sin_cos_two_pi(float u) {
  // Quarter turns are taken off exactly (Sterbenz): r is in [-1/8, 1/8] without rounding.
  const int quarter = static_cast<int>(4.0F * u + 0.5F);
  const float r = u - 0.25F * static_cast<float>(quarter);
  const float y = r * r;
  const float s = r * (6.28318548F + y * (-41.3416634F + y * (81.5925446F + y * -75.4016113F)));
  const float c =
      1.0F + y * (-19.7392082F + y * (64.9393692F + y * (-85.448822F + y * 59.4241066F)));
  const bool odd = (quarter & 1) != 0;
  const uint32_t sin_sign = static_cast<uint32_t>(quarter & 2) << 30;
  const uint32_t cos_sign = static_cast<uint32_t>((quarter + 1) & 2) << 30;
  return {std::bit_cast<float>(std::bit_cast<uint32_t>(choose(odd, c, s)) ^ sin_sign),
          std::bit_cast<float>(std::bit_cast<uint32_t>(choose(odd, s, c)) ^ cos_sign)};
}
inline SinCosOf<double> sin_cos_two_pi(double u) {
  const double angle = 2 * std::numbers::pi * u;
  return {std::sin(angle), std::cos(angle)};
}

/// log2(x) for normal x > 0, relative error at most 4e-7 (also next to x = 1); -1000 for x below
/// 2^-126, small enough to give an exact zero in all uses here.
inline float log2_of(float x) {
  if (!(x >= 0x1p-126F)) return -1000.0F;
  constexpr uint32_t sqrt_half_bits = 0x3f3504f3U;  // mantissas in [sqrt(1/2), sqrt(2))
  const uint32_t shifted = std::bit_cast<uint32_t>(x) - sqrt_half_bits;
  const int exponent = static_cast<int32_t>(shifted) >> 23;
  const float m = std::bit_cast<float>((shifted & 0x007fffffU) + sqrt_half_bits);
  const float s = (m - 1.0F) / (m + 1.0F);  // log2(m) = 2 atanh(s) / ln 2
  const float y = s * s;
  const float series =
      s * (2.88539004F + y * (0.961798847F + y * (0.576715171F + y * 0.431717694F)));
  return static_cast<float>(exponent) + series;
}
inline double log2_of(double x) {
  return x >= 0x1p-126 ? std::log2(x) : -1000.0;
}

/// 2^x = scale (1 + rest) for x in [-126, 0]: scale is a power of two, and rest is 2^f - 1 for f in
/// [-1/2, 1/2].
struct PowerOfTwo {
  float scale;
  float rest;
};
inline PowerOfTwo split_exp2(float x) {
  const int whole = static_cast<int>(x - 0.5F);  // truncation rounds up for x <= 0: nearest integer
  const float f = x - static_cast<float>(whole);
  const float high = 0.00961808302F + f * (0.00133908633F + f * 0.000154531634F);
  const float rest = f * (0.693147182F + f * (0.240226507F + f * (0.0555035695F + f * high)));
  return {std::bit_cast<float>(static_cast<uint32_t>(whole + 127) << 23), rest};
}

/// 2^x for x <= 0, relative error at most 3e-7; 0 below -126.
inline float exp2_of(float x) {
  if (!(x >= -126.0F)) return 0.0F;
  const PowerOfTwo power = split_exp2(x);
  return power.scale * (1.0F + power.rest);
}
inline double exp2_of(double x) {
  return x >= -126.0 ? std::exp2(x) : 0.0;
}

/// 2^x - 1 for x <= 0, relative error at most 4e-7 (also next to x = 0); -1 below -126.
inline float exp2_minus_one(float x) {
  if (!(x >= -126.0F)) return -1.0F;
  const PowerOfTwo power = split_exp2(x);
  return (power.scale - 1.0F) + power.scale * power.rest;
}
inline double exp2_minus_one(double x) {
  return x >= -126.0 ? std::expm1(x * std::numbers::ln2) : -1.0;
}

/// sqrt(x), or 0 if rounding has made x negative.
inline Real safe_sqrt(Real x) {
  return std::sqrt(std::max(0.0_r, x));
}

// ---- frames ------------------------------------------------------------------------------------

/// A right-handed orthonormal basis whose z is a given unit vector.
struct Basis {
  Vec3 x;
  Vec3 y;
  Vec3 z;

  Vec3 to_world(const Vec3& local) const { return x * local.x + y * local.y + z * local.z; }
  Vec3 to_local(const Vec3& world) const {
    return {glm::dot(x, world), glm::dot(y, world), glm::dot(z, world)};
  }
};

/// Basis about a unit vector, without a branch and valid for all directions (Duff et al., "Building
/// an Orthonormal Basis, Revisited", JCGT 6(1), 2017).
inline Basis basis_around(const Vec3& z) {
  const Real sign = std::copysign(1.0_r, z.z);
  const Real a = -1.0_r / (sign + z.z);
  const Real b = z.x * z.y * a;
  return {
      {1.0_r + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

/// Renormalises an almost unit vector (one Newton step, error squared): a direction that is rotated
/// thousands of times in thick smoke stays unit.
inline Vec3 renormalised(const Vec3& almost_unit) {
  return almost_unit * (1.5_r - 0.5_r * glm::dot(almost_unit, almost_unit));
}

/// A local direction about `axis` in world coordinates, unit.
inline Vec3 to_world(const Vec3& axis, const Vec3& local) {
  return renormalised(basis_around(axis).to_world(local));
}

/// Direction at polar angle theta about z, azimuth 2 pi v. 1 - cos theta represents narrow angles
/// exactly.
inline Vec3 direction_from_one_minus_cos(Real one_minus_cos, Real v) {
  const Real sin_theta = safe_sqrt(one_minus_cos * (2.0_r - one_minus_cos));
  const SinCos phi = sin_cos_two_pi(v);
  return {sin_theta * phi.cos, sin_theta * phi.sin, 1.0_r - one_minus_cos};
}

// ---- points and directions ---------------------------------------------------------------------

/// Density 1 / (4 pi) [1/sr].
inline Vec3 uniform_sphere(Real u, Real v) {
  return direction_from_one_minus_cos(2.0_r * u, v);
}

/// Density cos theta / pi [1/sr] about z; cos theta is at least 2^-12, so the direction always
/// leaves the surface.
inline Vec3 cosine_hemisphere(Real u, Real v) {
  const Real radius = std::sqrt(u);
  const SinCos phi = sin_cos_two_pi(v);
  return {radius * phi.cos, radius * phi.sin, std::sqrt(1.0_r - u)};
}

/// Density [1/sr] of cosine_hemisphere for a direction with this cosine.
inline Real cosine_pdf(Real cos_theta) {
  return std::max(0.0_r, cos_theta) * inverse_pi_f;
}

/// Uniform point of the unit disc.
inline Vec2 uniform_disc(Real u, Real v) {
  const Real radius = std::sqrt(u);
  const SinCos phi = sin_cos_two_pi(v);
  return {radius * phi.cos, radius * phi.sin};
}

/// Barycentrics (b0, b1, b2 >= 0, sum 1) of a uniform point of a triangle: folds the unit square
/// along its diagonal, area-preserving and without a square root (Heitz, "A Low-Distortion Map
/// Between Triangle and Square", 2019).
inline Vec3 uniform_triangle(Real u, Real v) {
  const bool above = v > u;
  const Real b0 = choose(above, 0.5_r * u, u - 0.5_r * v);
  const Real b1 = choose(above, v - 0.5_r * u, 0.5_r * v);
  return {b0, b1, (1.0_r - b0) - b1};
}

/// Density (n + 1) / (2 pi) cos^n theta [1/sr] over the hemisphere about z, for n >= 0; exact for
/// any n, also for narrow beams (n = 1e6). cos theta = (1 - u)^(1 / (n + 1)).
inline Vec3 cosine_power(Real n, Real u, Real v) {
  return direction_from_one_minus_cos(-exp2_minus_one(log2_of(1.0_r - u) / (n + 1.0_r)), v);
}

/// 1 - cos of the angle between two unit vectors; the cosine itself would lose the width of a
/// narrow beam.
inline Real one_minus_cosine(const Vec3& a, const Vec3& b) {
  const Vec3 between = a - b;
  return 0.5_r * glm::dot(between, between);
}

/// Density [1/sr] of cosine_power, x = 1 - cos(theta); 0 below the horizon.
inline Real cosine_power_pdf(Real n, Real x) {
  if (!(x < 1.0_r)) return n == 0.0_r && x == 1.0_r ? 0.5_r * inverse_pi_f : 0.0_r;
  constexpr Real log2_e = std::numbers::log2e_v<Real>;
  // Near the axis by the series of log(1 - x): 1 - x is rounded, and a high power magnifies the
  // error.
  const Real log2_cos = x < 1e-3_r ? -log2_e * x * (1 + x * (0.5_r + x / 3)) : log2_of(1 - x);
  return (n + 1.0_r) * 0.5_r * inverse_pi_f * exp2_of(n * log2_cos);
}

/// A spot about z: full intensity within the inner half angle, none beyond the outer one, and
/// between them the smooth step t^2 (3 - 2t) of t = (cos theta - cos outer) / (cos inner - cos
/// outer). Its integral is a polynomial in the cosine, so flux and sampling are exact.
struct SpotLobe {
  Real inner_one_minus_cos = 0;
  Real outer_one_minus_cos = 0;
  Real core_share = 1;  // share of the flux within the inner angle

  /// Requires: 0 <= inner <= outer <= pi, outer > 0 [rad].
  static SpotLobe from_half_angles(double inner_rad, double outer_rad) {
    const double inner = 2.0 * std::sin(0.5 * inner_rad) * std::sin(0.5 * inner_rad);
    const double outer = 2.0 * std::sin(0.5 * outer_rad) * std::sin(0.5 * outer_rad);
    return {static_cast<Real>(inner), static_cast<Real>(outer),
            static_cast<Real>(2.0 * inner / (inner + outer))};
  }
  /// Flux [lm] for 1 cd on the axis: the integral of the relative intensity [sr].
  Real solid_angle() const { return pi_f * (inner_one_minus_cos + outer_one_minus_cos); }
  /// Intensity relative to the axis, [0, 1]; x = 1 - cos(theta).
  Real relative_intensity(Real x) const {
    if (x <= inner_one_minus_cos) return 1.0_r;
    if (x >= outer_one_minus_cos) return 0.0_r;
    const Real t = (outer_one_minus_cos - x) / (outer_one_minus_cos - inner_one_minus_cos);
    return t * t * (3.0_r - 2.0_r * t);
  }
  /// Direction with density relative_intensity / solid_angle [1/sr].
  Vec3 sample(Real u, Real v) const {
    if (u < core_share) {
      return direction_from_one_minus_cos(u / core_share * inner_one_minus_cos, v);
    }
    const Real t = fall_off_quantile((1.0_r - u) / (1.0_r - core_share));
    const Real x = outer_one_minus_cos - t * (outer_one_minus_cos - inner_one_minus_cos);
    return direction_from_one_minus_cos(x, v);
  }

 private:
  /// The t in [0, 1] with t^3 (2 - t) = y: inverts the distribution function of the smooth step.
  static Real fall_off_quantile(Real y) {
    // The root is between cbrt(y / 2) and cbrt(y). This start, between them, is within 8 % of it,
    // and three Newton steps on a convex function then reach rounding.
    Real t = exp2_of((1.0_r / 3.0_r) * log2_of(y * (1.0_r / (2.0_r - 0.8_r * y))));
    for (int step = 0; step < 3; ++step) {
      const Real square = t * t;
      const Real excess = square * t * (2.0_r - t) - y;
      t -= excess / std::max(square * (6.0_r - 4.0_r * t), 1e-30_r);
    }
    return std::clamp(t, 0.0_r, 1.0_r);
  }
};

}  // namespace luxodus
