// A ray, a hit, and the record of a triangle: what the tracer and the intersectors exchange.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace luxodus {

struct Ray {
  glm::vec3 origin;     // local coordinates [m]
  glm::vec3 direction;  // unit
  float length = std::numeric_limits<float>::infinity();
};

inline constexpr uint32_t no_triangle = 0xFFFFFFFF;

/// All that a hit needs of its triangle, one cache line.
struct TriangleRecord {
  glm::vec3 corner[3];
  glm::vec3 normal;          // unit, front side
  uint32_t first_patch;      // flux bins: front side first, then back: 2 * subdivision^2
  uint32_t subdivision;      // patches per edge
  uint32_t surface;          // index of the object it belongs to
  uint32_t global_triangle;  // its number in the whole scene: ties go to the smaller

  /// The point at barycentrics (u, v), kept off the edges by 2^-16 of the triangle: a point that
  /// rounding puts beyond a neighbour in a corner of the room would see the outside.
  glm::vec3 at(float u, float v) const {
    constexpr float margin = 0x1p-16f;
    u = u < margin ? margin : u;
    v = v < margin ? margin : v;
    float w = 1 - u - v;
    if (w < margin) {
      const float shrink = (1 - margin) / (u + v);
      u *= shrink;
      v *= shrink;
      w = margin;
    }
    return corner[0] * w + corner[1] * u + corner[2] * v;
  }
};
static_assert(sizeof(TriangleRecord) == 64);

struct GeometryCell;

struct Hit {
  float distance = std::numeric_limits<float>::infinity();
  float u = 0, v = 0;            // barycentrics of corners 1 and 2
  uint32_t index = no_triangle;  // within the cell
  const TriangleRecord* triangle = nullptr;
  const GeometryCell* cell = nullptr;

  bool found() const { return triangle != nullptr; }
};

}  // namespace luxodus
