// Directions and points from uniform numbers: the small float functions of the tracer's innermost
// loop. Promise: the same bits on any thread and any node of one instruction set, because only +,
// -, *, /, sqrt and bit patterns are used (all rounded by IEEE 754) and never the C library's own
// elementary functions. u and v are floats in [0, 1) made by unit_float; a direction is unit to
// 3e-7. Local frames: z is the axis. Not here: random numbers, and densities of anything that
// depends on a scene. Any thread, no state.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace luxodus {

inline constexpr float pi_f = 3.14159265F;
inline constexpr float inverse_pi_f = 0.318309886F;

/// The upper 24 bits of a random word as a float: multiples of 2^-24 in [0, 1), every one of them
/// exact.
inline float unit_float(uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24F;
}

/// `condition ? a : b` without a branch: on random conditions a mispredicted one costs more than
/// both sides.
inline float choose(bool condition, float a, float b) {
  const uint32_t mask = 0U - static_cast<uint32_t>(condition);
  return std::bit_cast<float>((std::bit_cast<uint32_t>(a) & mask) |
                              (std::bit_cast<uint32_t>(b) & ~mask));
}

// ---- elementary functions ----------------------------------------------------------------------
// Polynomials interpolate at the Chebyshev nodes of their range (computed for this file in double).

struct SinCos {
  float sin;
  float cos;
};

/// sin and cos of 2 pi u for u in [0, 1]. Absolute error at most 1.2e-7 (tested on all 2^24 + 1
/// inputs).
inline SinCos sin_cos_two_pi(float u) {
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

/// log2(x) for normal x > 0, relative error at most 4e-7 (also next to x = 1); -1000 for x below
/// 2^-126, far enough for every use here to end in an exact zero.
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

/// 2^x = scale (1 + rest) for x in [-126, 0]: a whole power of two, and 2^f - 1 for f in [-1/2,
/// 1/2].
struct PowerOfTwo {
  float scale;
  float rest;
};
inline PowerOfTwo split_exp2(float x) {
  const int whole = static_cast<int>(x - 0.5F);  // truncation is upwards for x <= 0: the nearest
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

/// 2^x - 1 for x <= 0, relative error at most 4e-7 (also next to x = 0); -1 below -126.
inline float exp2_minus_one(float x) {
  if (!(x >= -126.0F)) return -1.0F;
  const PowerOfTwo power = split_exp2(x);
  return (power.scale - 1.0F) + power.scale * power.rest;
}

/// sqrt(x), and 0 where rounding has pushed x below 0.
inline float safe_sqrt(float x) {
  return std::sqrt(std::max(0.0F, x));
}

// ---- frames ------------------------------------------------------------------------------------

/// A right-handed orthonormal basis whose z is a given unit vector.
struct Basis {
  glm::vec3 x;
  glm::vec3 y;
  glm::vec3 z;

  glm::vec3 to_world(const glm::vec3& local) const {
    return x * local.x + y * local.y + z * local.z;
  }
  glm::vec3 to_local(const glm::vec3& world) const {
    return {glm::dot(x, world), glm::dot(y, world), glm::dot(z, world)};
  }
};

/// Basis about a unit vector, without a branch and without a bad direction (Duff et al., "Building
/// an Orthonormal Basis, Revisited", JCGT 6(1), 2017).
inline Basis basis_around(const glm::vec3& z) {
  const float sign = std::copysign(1.0F, z.z);
  const float a = -1.0F / (sign + z.z);
  const float b = z.x * z.y * a;
  return {{1.0F + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

/// Takes off the drift of an almost unit vector (one Newton step, error squared): a direction that
/// is turned thousands of times in thick smoke stays unit.
inline glm::vec3 renormalised(const glm::vec3& almost_unit) {
  return almost_unit * (1.5F - 0.5F * glm::dot(almost_unit, almost_unit));
}

/// A local direction about `axis` in world coordinates, unit.
inline glm::vec3 to_world(const glm::vec3& axis, const glm::vec3& local) {
  return renormalised(basis_around(axis).to_world(local));
}

/// Direction at polar angle theta about z, azimuth 2 pi v. 1 - cos theta says narrow angles
/// exactly.
inline glm::vec3 direction_from_one_minus_cos(float one_minus_cos, float v) {
  const float sin_theta = safe_sqrt(one_minus_cos * (2.0F - one_minus_cos));
  const SinCos phi = sin_cos_two_pi(v);
  return {sin_theta * phi.cos, sin_theta * phi.sin, 1.0F - one_minus_cos};
}

// ---- points and directions ---------------------------------------------------------------------

/// Density 1 / (4 pi) [1/sr].
inline glm::vec3 uniform_sphere(float u, float v) {
  return direction_from_one_minus_cos(2.0F * u, v);
}

/// Density cos theta / pi [1/sr] about z; cos theta is at least 2^-12, so the surface is always
/// left.
inline glm::vec3 cosine_hemisphere(float u, float v) {
  const float radius = std::sqrt(u);
  const SinCos phi = sin_cos_two_pi(v);
  return {radius * phi.cos, radius * phi.sin, std::sqrt(1.0F - u)};
}

/// Uniform point of the unit disc.
inline glm::vec2 uniform_disc(float u, float v) {
  const float radius = std::sqrt(u);
  const SinCos phi = sin_cos_two_pi(v);
  return {radius * phi.cos, radius * phi.sin};
}

/// Barycentrics (b0, b1, b2 >= 0, sum 1) of a uniform point of a triangle: the square folded on its
/// diagonal, area-preserving and without a root (Heitz, "A Low-Distortion Map Between Triangle and
/// Square", 2019).
inline glm::vec3 uniform_triangle(float u, float v) {
  const bool above = v > u;
  const float b0 = choose(above, 0.5F * u, u - 0.5F * v);
  const float b1 = choose(above, v - 0.5F * u, 0.5F * v);
  return {b0, b1, (1.0F - b0) - b1};
}

/// Uniform in the cone about z with cos theta >= 1 - one_minus_cos_outer: density
/// 1 / (2 pi one_minus_cos_outer) [1/sr].
inline glm::vec3 uniform_cone(float one_minus_cos_outer, float u, float v) {
  return direction_from_one_minus_cos(u * one_minus_cos_outer, v);
}

/// Density (n + 1) / (2 pi) cos^n theta [1/sr] over the hemisphere about z, for n >= 0; exact for
/// any n, narrow beams (n = 1e6) too. cos theta = (1 - u)^(1 / (n + 1)).
inline glm::vec3 cosine_power(float n, float u, float v) {
  return direction_from_one_minus_cos(-exp2_minus_one(log2_of(1.0F - u) / (n + 1.0F)), v);
}

/// Density [1/sr] of cosine_power; 0 below the horizon.
inline float cosine_power_pdf(float n, float cos_theta) {
  if (!(cos_theta > 0.0F)) return n == 0.0F && cos_theta == 0.0F ? 0.5F * inverse_pi_f : 0.0F;
  const float power = exp2_of(n * log2_of(std::min(1.0F, cos_theta)));
  return (n + 1.0F) * 0.5F * inverse_pi_f * power;
}

/// A spot about z: full intensity within the inner half angle, none beyond the outer, between them
/// the smooth step t^2 (3 - 2t) of t = (cos theta - cos outer) / (cos inner - cos outer). In the
/// cosine its integral is a polynomial, so flux and sampling are exact.
struct SpotLobe {
  float inner_one_minus_cos = 0;
  float outer_one_minus_cos = 0;
  float core_share = 1;  // share of the flux within the inner angle

  /// Requires: 0 <= inner <= outer <= pi, outer > 0 [rad].
  static SpotLobe from_half_angles(double inner_rad, double outer_rad) {
    const double inner = 2.0 * std::sin(0.5 * inner_rad) * std::sin(0.5 * inner_rad);
    const double outer = 2.0 * std::sin(0.5 * outer_rad) * std::sin(0.5 * outer_rad);
    return {static_cast<float>(inner), static_cast<float>(outer),
            static_cast<float>(2.0 * inner / (inner + outer))};
  }
  /// Flux [lm] of 1 cd on the axis: the integral of the relative intensity [sr].
  float solid_angle() const { return pi_f * (inner_one_minus_cos + outer_one_minus_cos); }
  /// Intensity relative to the axis, [0, 1].
  float relative_intensity(float cos_theta) const {
    const float x = 1.0F - cos_theta;
    if (x <= inner_one_minus_cos) return 1.0F;
    if (x >= outer_one_minus_cos) return 0.0F;
    const float t = (outer_one_minus_cos - x) / (outer_one_minus_cos - inner_one_minus_cos);
    return t * t * (3.0F - 2.0F * t);
  }
  /// Direction with density relative_intensity / solid_angle [1/sr].
  glm::vec3 sample(float u, float v) const {
    if (u < core_share) {
      return direction_from_one_minus_cos(u / core_share * inner_one_minus_cos, v);
    }
    const float t = fall_off_quantile((1.0F - u) / (1.0F - core_share));
    const float x = outer_one_minus_cos - t * (outer_one_minus_cos - inner_one_minus_cos);
    return direction_from_one_minus_cos(x, v);
  }

 private:
  /// t in [0, 1] with t^3 (2 - t) = y: the distribution function of the smooth step, inverted.
  static float fall_off_quantile(float y) {
    // The root is between cbrt(y / 2) and cbrt(y); this mean of them is within 8 % of it, and three
    // Newton steps on a convex function end at rounding.
    float t = exp2_of((1.0F / 3.0F) * log2_of(y * (1.0F / (2.0F - 0.8F * y))));
    for (int step = 0; step < 3; ++step) {
      const float square = t * t;
      const float excess = square * t * (2.0F - t) - y;
      t -= excess / std::max(square * (6.0F - 4.0F * t), 1e-30F);
    }
    return std::clamp(t, 0.0F, 1.0F);
  }
};

}  // namespace luxodus
