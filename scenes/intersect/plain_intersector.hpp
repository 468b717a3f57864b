// Rays and triangles by arithmetic of any number type, without Embree: what a build that computes
// in double answers rays with, every triangle in turn. Edges are told by volumes that two
// neighbours compute from the same numbers with opposite signs to the last bit (Plücker products,
// as in Embree's ROBUST mode), so that no ray passes between triangles that share an edge; one
// aimed at a corner to the last bit may. Both sides count. Any thread, no state.
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

/// Volumes spanned by the ray's direction and each edge, seen from its origin: signs tell on which
/// side of an edge the line passes, sizes are the barycentrics of the opposite corners.
template <class T>
struct EdgeVolumes {
  T of_corner[3];

  T sum() const { return of_corner[0] + of_corner[1] + of_corner[2]; }
  /// The line meets the triangle, edges included; one that runs within its plane does not.
  bool inside() const {
    if (sum() == 0) return false;
    return (of_corner[0] >= 0 && of_corner[1] >= 0 && of_corner[2] >= 0) ||
           (of_corner[0] <= 0 && of_corner[1] <= 0 && of_corner[2] <= 0);
  }
};

template <class T>
EdgeVolumes<T> edge_volumes(const PlainRay<T>& ray, const TriangleRecord& triangle) {
  using Vec = glm::vec<3, T>;
  const Vec a = Vec(triangle.corner[0]) - ray.origin;
  const Vec b = Vec(triangle.corner[1]) - ray.origin;
  const Vec c = Vec(triangle.corner[2]) - ray.origin;
  return {{glm::dot(ray.direction, glm::cross(c, b)), glm::dot(ray.direction, glm::cross(a, c)),
           glm::dot(ray.direction, glm::cross(b, a))}};
}

/// Where a line meets a triangle's plane; the distance is NaN or infinite where it is parallel.
template <class T>
struct PlaneMeeting {
  T distance;
  T u, v;  // barycentrics of corners 1 and 2
};

template <class T>
PlaneMeeting<T> meet_plane(const PlainRay<T>& ray, const TriangleRecord& triangle,
                           const EdgeVolumes<T>& volumes) {
  using Vec = glm::vec<3, T>;
  const Vec corner(triangle.corner[0]);
  const Vec across = glm::cross(Vec(triangle.corner[1]) - corner, Vec(triangle.corner[2]) - corner);
  return {glm::dot(across, corner - ray.origin) / glm::dot(across, ray.direction),
          volumes.of_corner[1] / volumes.sum(), volumes.of_corner[2] / volumes.sum()};
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
    const EdgeVolumes<T> volumes = edge_volumes(ray, triangles[i]);
    if (!volumes.inside()) continue;
    const PlaneMeeting<T> m = meet_plane(ray, triangles[i], volumes);
    if (!(m.distance > 0 && m.distance <= ray.length)) continue;
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
    const EdgeVolumes<T> volumes = edge_volumes(ray, triangle);
    if (!volumes.inside()) continue;
    const T distance = meet_plane(ray, triangle, volumes).distance;
    if (distance > 0 && distance < ray.length) return true;
  }
  return false;
}

}  // namespace luxodus
