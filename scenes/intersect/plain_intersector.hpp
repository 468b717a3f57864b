// Rays and triangles by arithmetic of any number type, without Embree: what a build that computes
// in double answers rays with, every triangle in turn. Edges are told by volumes that two
// neighbours compute from the same numbers with opposite signs to the last bit (Plücker products,
// as in Embree's ROBUST mode), so
// that no ray passes between triangles that share corners. Both sides count. Any thread, no state.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "scenes/intersect/ray.hpp"

namespace luxodus {

namespace limits {
/// Triangles up to which every one is asked: some 10 ns each, so that a ray costs 10 us at most.
inline constexpr size_t plain_triangles = 1000;
}  // namespace limits

template <class T>
struct PlainRay {
  glm::vec<3, T> origin;
  glm::vec<3, T> direction;
  T length = std::numeric_limits<T>::infinity();
};

/// Where a line meets a triangle's plane.
template <class T>
struct PlaneMeeting {
  T distance = std::numeric_limits<T>::quiet_NaN();  // NaN or infinite: parallel
  T u = 0, v = 0;                                    // barycentrics of corners 1 and 2
  bool inside = false;                               // of the triangle, edges included
};

template <class T>
PlaneMeeting<T> meet_plane(const PlainRay<T>& ray, const TriangleRecord& triangle) {
  using Vec = glm::vec<3, T>;
  const Vec corner0(triangle.corner[0]), corner1(triangle.corner[1]), corner2(triangle.corner[2]);
  const Vec a = corner0 - ray.origin, b = corner1 - ray.origin, c = corner2 - ray.origin;
  const T of_a = glm::dot(ray.direction, glm::cross(c, b));
  const T of_b = glm::dot(ray.direction, glm::cross(a, c));
  const T of_c = glm::dot(ray.direction, glm::cross(b, a));
  const T sum = of_a + of_b + of_c;
  if (sum == 0) return {};
  const Vec across = glm::cross(corner1 - corner0, corner2 - corner0);
  const bool inside =
      (of_a >= 0 && of_b >= 0 && of_c >= 0) || (of_a <= 0 && of_b <= 0 && of_c <= 0);
  return {glm::dot(across, a) / glm::dot(across, ray.direction), of_b / sum, of_c / sum, inside};
}

/// A hit among triangles; `index` is no_triangle where there is none.
template <class T>
struct PlainHit {
  T distance = std::numeric_limits<T>::infinity();
  T u = 0, v = 0;
  uint32_t index = no_triangle;
};

/// Nearest triangle within (0, ray.length]; equal distances go to the smaller global triangle.
template <class T>
PlainHit<T> plain_nearest(std::span<const TriangleRecord> triangles, const PlainRay<T>& ray) {
  PlainHit<T> best;
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const PlaneMeeting<T> m = meet_plane(ray, triangles[i]);
    if (!m.inside || !(m.distance > 0 && m.distance <= ray.length)) continue;
    const bool nearer = m.distance < best.distance;
    const bool tie = m.distance == best.distance && best.index != no_triangle &&
                     triangles[i].global_triangle < triangles[best.index].global_triangle;
    if (nearer || tie) best = {m.distance, m.u, m.v, i};
  }
  return best;
}

/// Whether any triangle lies within (0, ray.length).
template <class T>
bool plain_occluded(std::span<const TriangleRecord> triangles, const PlainRay<T>& ray) {
  for (const TriangleRecord& triangle : triangles) {
    const PlaneMeeting<T> m = meet_plane(ray, triangle);
    if (m.inside && m.distance > 0 && m.distance < ray.length) return true;
  }
  return false;
}

}  // namespace luxodus
