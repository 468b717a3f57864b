// Checks of dimensions that all shapes share, and the quad strip they all use. Private to the shape
// sources of this room. Pure functions; any thread.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/primitives.hpp"

namespace luxodus::shapes {

using Measure = std::pair<const char*, double>;

/// Errors: the first measure that is not a positive length.
inline Result<void> check_lengths(std::initializer_list<Measure> measures) {
  for (const auto& [name, value] : measures) {
    if (value > 0 && value <= limits::shape_length_m) continue;
    return problem(fmt::format("{} is {}: give a length above 0 and up to {:g} m", name, value,
                               limits::shape_length_m));
  }
  return {};
}

inline Result<void> check_count(const char* name, int value, int least, int most) {
  if (value >= least && value <= most) return {};
  return problem(fmt::format("{} is {}: give {} to {}", name, value, least, most));
}

inline bool finite_within_limit(const glm::dvec3& v) {
  // Written so that NaN fails.
  return std::abs(v.x) <= limits::shape_length_m && std::abs(v.y) <= limits::shape_length_m &&
         std::abs(v.z) <= limits::shape_length_m;
}

/// Two triangles a b c, a c d: counter-clockwise a, b, c, d seen from the front.
inline void add_quad(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// A rectangle with its own four vertices and texture coordinates for one whole picture.
inline void add_picture_quad(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& edge_u,
                             const glm::dvec3& edge_v) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  const glm::dvec3 opposite = corner + edge_u + edge_v;
  mesh.positions.insert(mesh.positions.end(), {corner, corner + edge_u, opposite, corner + edge_v});
  mesh.texture_uv.insert(mesh.texture_uv.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_quad(mesh, first, first + 1, first + 2, first + 3);
}

}  // namespace luxodus::shapes
