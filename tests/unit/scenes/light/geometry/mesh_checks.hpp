// Brute-force checks of meshes for tests. Pure functions; any thread.
#pragma once

#include <array>
#include <map>
#include <utility>

#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus::test {

using Point = std::array<double, 3>;

inline Point key(const glm::dvec3& p) {
  return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
}

/// Whether every directed edge, by the exact bits of its ends, is matched by one in the opposite
/// direction: the mesh is closed, consistently oriented and free of T-junctions. `max_pairs` allows
/// edges at which bodies touch along a line.
inline bool is_closed(const Mesh& mesh, int max_pairs = 1) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      ++edges[{key(mesh.positions[t[i]]), key(mesh.positions[t[(i + 1) % 3]])}];
    }
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (back == edges.end() || back->second != count || count > max_pairs) return false;
  }
  return !edges.empty();
}

inline glm::dvec3 normal_of(const Mesh& mesh, size_t triangle) {
  const glm::uvec3 t = mesh.triangles[triangle];
  const glm::dvec3 a = mesh.positions[t.x];
  return glm::normalize(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
}

inline bool all_face(const Mesh& mesh, const glm::dvec3& direction) {
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (glm::dot(normal_of(mesh, i), direction) < 1 - 1e-12) return false;
  }
  return !mesh.triangles.empty();
}

}  // namespace luxodus::test
