// Flux patches: every triangle is cut into n x n congruent barycentric sub-triangles, so that flux
// can be resolved finer than the traced geometry. Inline, without allocation and with branches that
// depend on the point alone, since it runs at every hit. Pure; any thread.
//
// A point of the triangle (p0, p1, p2) is (1 - u - v) p0 + u p1 + v p2, as Embree reports it. Row i
// holds i/n <= u < (i+1)/n, with 2 (n - i) - 1 triangles; the rows before it hold i (2n - i). In
// the row, square j of the (u, v) grid gives a lower triangle and, where it is whole, an upper one:
//
//   v ^                index = i (2n - i) + 2 j + upper
//     |\               drawn: n = 2, u to the right
//     |2\              row 0: 0 lower, 1 upper (j = 0), 2 lower (j = 1)
//     |--\             row 1: 3 lower
//     |\1|\            .
//     |0\|3\  -> u
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

namespace limits {
/// 2^30 patches of one triangle, far more than any tally holds; keeps i (2n - i) within 32 bits.
inline constexpr uint32_t patch_subdivision = 32768;
}  // namespace limits

/// Index in [0, n*n) of the sub-triangle that holds (u, v). Rounding beyond the edges (u + v a
/// little above 1, u a little below 0) lands in the nearest one along v; NaN counts as 0.
/// Requires: 1 <= n <= limits::patch_subdivision.
inline uint32_t sub_triangle(Real u, Real v, uint32_t n) {
  const Real most = static_cast<Real>(n);
  const Real un = u > 0 ? std::min(u * most, most) : 0;
  const Real vn = v > 0 ? std::min(v * most, most) : 0;
  const uint32_t i = std::min(static_cast<uint32_t>(un), n - 1);
  const uint32_t last_j = n - 1 - i;
  const uint32_t j = std::min(static_cast<uint32_t>(vn), last_j);
  const Real across = (un - static_cast<Real>(i)) + (vn - static_cast<Real>(j));
  const uint32_t upper = (across > 1 && j < last_j) ? 1u : 0u;
  return i * (2 * n - i) + 2 * j + upper;
}

/// The three (u, v) corners, in the winding of the whole triangle.
/// Requires: 1 <= n <= limits::patch_subdivision, index < n * n.
inline std::array<glm::dvec2, 3> sub_triangle_corners(uint32_t index, uint32_t n) {
  // Triangles from this one to the end: (n - i - 1)^2 < left <= (n - i)^2.
  const uint32_t left = n * n - index;
  auto root = static_cast<uint32_t>(std::sqrt(static_cast<double>(left)));
  while (root * root < left) ++root;
  const uint32_t i = n - root;
  const uint32_t in_row = index - i * (2 * n - i);
  const uint32_t j = in_row / 2;
  const double step = static_cast<double>(n);
  const double u0 = i / step, u1 = (i + 1) / step;
  const double v0 = j / step, v1 = (j + 1) / step;
  if (in_row % 2 == 0) return {glm::dvec2(u0, v0), glm::dvec2(u1, v0), glm::dvec2(u0, v1)};
  return {glm::dvec2(u1, v1), glm::dvec2(u0, v1), glm::dvec2(u1, v0)};
}

/// The least n for which no patch edge exceeds `patch_edge_m`; 1 if that is 0 or less. A relative
/// 1e-9 is tolerated, so that 0.9 m by 0.3 m gives 3, not 4. Never above limits::patch_subdivision,
/// even if a finer one is asked for; the caller sees this in the resulting edge.
inline uint32_t subdivision_for(double longest_edge_m, double patch_edge_m) {
  if (!(patch_edge_m > 0) || !(longest_edge_m > 0)) return 1;
  const double n = std::ceil(longest_edge_m / patch_edge_m * (1 - 1e-9));
  const double most = static_cast<double>(limits::patch_subdivision);
  return static_cast<uint32_t>(std::clamp(n, 1.0, most));
}

}  // namespace luxodus
