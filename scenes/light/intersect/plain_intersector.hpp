// Ray-triangle intersection in any number type, without Embree: a double-precision build uses it
// for small cells. It tests each triangle of every group whose box the ray hits. Two triangles that
// share an edge compute its edge volume from the same numbers with exactly opposite signs (Plücker
// products, as in Embree's ROBUST mode), so no ray passes between them; a ray aimed exactly at a
// corner may. Both sides count. No state; any thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "scenes/light/intersect/ray.hpp"

namespace luxodus {

namespace limits {
/// Largest number of triangles that are tested one by one: some 10 ns each, so 10 us per ray at
/// most.
inline constexpr size_t plain_triangles = 1000;
}  // namespace limits

template <class T>
struct PlainRay {
  glm::vec<3, T> origin;
  glm::vec<3, T> direction;
  T length = std::numeric_limits<T>::infinity();
};

/// Volumes spanned by the ray's direction and each edge, seen from its origin: the signs say on
/// which side of an edge the line passes, the sizes are the barycentrics of the opposite corners.
template <class T>
struct EdgeVolumes {
  T of_corner[3];

  T sum() const { return of_corner[0] + of_corner[1] + of_corner[2]; }
  /// Whether the line hits the triangle, edges included; a line within its plane does not.
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

/// Where a line hits a triangle's plane; the distance is NaN or infinite if it is parallel.
template <class T>
struct PlaneIntersection {
  T distance;
  T u, v;  // barycentrics of corners 1 and 2
};

template <class T>
PlaneIntersection<T> meet_plane(const PlainRay<T>& ray, const TriangleRecord& triangle,
                                const EdgeVolumes<T>& volumes) {
  using Vec = glm::vec<3, T>;
  const Vec corner(triangle.corner[0]);
  const Vec across = glm::cross(Vec(triangle.corner[1]) - corner, Vec(triangle.corner[2]) - corner);
  return {glm::dot(across, corner - ray.origin) / glm::dot(across, ray.direction),
          volumes.of_corner[1] / volumes.sum(), volumes.of_corner[2] / volumes.sum()};
}

/// So many consecutive triangles share one box; most rays miss most boxes.
inline constexpr size_t plain_group = 8;

struct PlainBox {
  glm::vec3 low, high;
};

/// The boxes of all groups, enlarged by far more than the rounding of any test.
inline std::vector<PlainBox> plain_boxes(std::span<const TriangleRecord> triangles) {
  std::vector<PlainBox> boxes;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const auto& corner = triangles[i].corner;
    if (i % plain_group == 0) boxes.push_back({corner[0], corner[0]});
    for (const glm::vec3& at : corner) {
      boxes.back().low = glm::min(boxes.back().low, at);
      boxes.back().high = glm::max(boxes.back().high, at);
    }
  }
  for (PlainBox& box : boxes) {
    const glm::vec3 wider = 1e-5f * (glm::max(glm::abs(box.low), glm::abs(box.high)) + 1.0f);
    box.low -= wider;
    box.high += wider;
  }
  return boxes;
}

/// Tests which boxes a ray hits within its length.
template <class T>
class BoxTest {
 public:
  explicit BoxTest(const PlainRay<T>& ray) : origin_(ray.origin), length_(ray.length) {
    constexpr T least = T(1e-30);  // no component is 0, so that no slab test makes a NaN
    for (int k = 0; k < 3; ++k)
      per_metre_[k] = 1 / (ray.direction[k] == 0 ? least : ray.direction[k]);
  }
  bool meets(const PlainBox& box) const {
    T enters = 0, leaves = length_;
    for (int k = 0; k < 3; ++k) {
      const T a = (static_cast<T>(box.low[k]) - origin_[k]) * per_metre_[k];
      const T b = (static_cast<T>(box.high[k]) - origin_[k]) * per_metre_[k];
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves;
  }

 private:
  glm::vec<3, T> origin_, per_metre_;
  T length_;
};

/// Calls `ask(i)` for the triangles of groups whose box the ray hits (of all groups if there are no
/// boxes) until it returns true.
template <class T, class Ask>
void ask_triangles(size_t count, std::span<const PlainBox> boxes, const PlainRay<T>& ray,
                   Ask&& ask) {
  const BoxTest<T> test(ray);
  for (size_t first = 0; first < count; first += plain_group) {
    if (!boxes.empty() && !test.meets(boxes[first / plain_group])) continue;
    const size_t end = std::min(count, first + plain_group);
    for (size_t i = first; i < end; ++i) {
      if (ask(static_cast<uint32_t>(i))) return;
    }
  }
}

/// The nearest hit; `index` is no_triangle if there is none.
template <class T>
struct PlainHit {
  T distance = std::numeric_limits<T>::infinity();
  T u = 0, v = 0;
  uint32_t index = no_triangle;
};

/// Nearest triangle within (0, ray.length]; ties in distance go to the smaller global triangle.
template <class T>
PlainHit<T> plain_nearest(std::span<const TriangleRecord> triangles, const PlainRay<T>& ray,
                          std::span<const PlainBox> boxes = {}) {
  PlainHit<T> best;
  ask_triangles(triangles.size(), boxes, ray, [&](uint32_t i) {
    const EdgeVolumes<T> volumes = edge_volumes(ray, triangles[i]);
    if (!volumes.inside()) return false;
    const PlaneIntersection<T> m = meet_plane(ray, triangles[i], volumes);
    if (!(m.distance > 0 && m.distance <= ray.length)) return false;
    const bool nearer = m.distance < best.distance;
    const bool tie = m.distance == best.distance && best.index != no_triangle &&
                     triangles[i].global_triangle < triangles[best.index].global_triangle;
    if (nearer || tie) best = {m.distance, m.u, m.v, i};
    return false;
  });
  return best;
}

/// Whether any triangle lies within (0, ray.length).
template <class T>
bool plain_occluded(std::span<const TriangleRecord> triangles, const PlainRay<T>& ray,
                    std::span<const PlainBox> boxes = {}) {
  bool met = false;
  ask_triangles(triangles.size(), boxes, ray, [&](uint32_t i) {
    const EdgeVolumes<T> volumes = edge_volumes(ray, triangles[i]);
    if (!volumes.inside()) return false;
    const T distance = meet_plane(ray, triangles[i], volumes).distance;
    met = distance > 0 && distance < ray.length;
    return met;
  });
  return met;
}

}  // namespace luxodus
