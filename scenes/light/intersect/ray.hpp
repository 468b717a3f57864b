// A ray, a hit, and the record of a triangle: shared by the tracer and the intersectors. Plain
// values; any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

struct Ray {
  Vec3 origin;     // local coordinates [m]
  Vec3 direction;  // unit
  Real length = std::numeric_limits<Real>::infinity();
};

inline constexpr uint32_t no_triangle = 0xFFFFFFFF;

/// All that a hit needs of its triangle, in one cache line.
struct TriangleRecord {
  glm::vec3 corner[3];
  glm::vec3 normal;          // unit, front side
  uint32_t first_patch;      // flux bins: front side first, then back: 2 * subdivision^2
  uint16_t subdivision;      // patches per edge
  uint16_t edge_margin;      // in 2^-16 of a barycentric, see `at`; at most `max_edge_margin`
  uint32_t surface;          // index of the object it belongs to
  uint32_t global_triangle;  // index in the whole scene: ties in distance go to the smaller

  static constexpr uint16_t max_edge_margin = 1024;  // 1/64

  /// The point at barycentrics (u, v), kept off the edges: in a corner of the room, a ray that
  /// starts nearer to a neighbouring wall than its own offset would start beyond that wall,
  /// outside.
  Vec3 at(Real u, Real v) const {
    const Real margin = static_cast<Real>(edge_margin) * 0x1p-16_r;
    u = u < margin ? margin : u;
    v = v < margin ? margin : v;
    Real w = 1 - u - v;
    if (w < margin) {
      const Real shrink = (1 - margin) / (u + v);
      u *= shrink;
      v *= shrink;
      w = margin;
    }
    return Vec3(corner[0]) * w + Vec3(corner[1]) * u + Vec3(corner[2]) * v;
  }

  /// The normal at the precision of the build: as stored, or recomputed from the corners in double.
  Vec3 unit_normal() const {
    if constexpr (computes_in_double) {
      const Vec3 a(corner[0]);
      const Vec3 across = glm::cross(Vec3(corner[1]) - a, Vec3(corner[2]) - a);
      const Real twice_area = glm::length(across);
      if (twice_area > 0) return across / twice_area;
    }
    return Vec3(normal);
  }
};
static_assert(sizeof(TriangleRecord) == 64);

struct GeometryCell;

struct Hit {
  Real distance = std::numeric_limits<Real>::infinity();
  Real u = 0, v = 0;             // barycentrics of corners 1 and 2
  uint32_t index = no_triangle;  // within the cell
  const TriangleRecord* triangle = nullptr;
  const GeometryCell* cell = nullptr;

  bool found() const { return triangle != nullptr; }
};

}  // namespace luxodus
