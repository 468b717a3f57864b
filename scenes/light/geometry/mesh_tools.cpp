#include "scenes/light/geometry/mesh_tools.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace luxodus {
namespace {

/// |cross(e1, e2)| of a collinear triple is not exactly zero: each product is rounded at 2^-53 of
/// the squared edge. Forty times that is still far below any intended triangle.
constexpr double flat_ratio = 1e-14;

struct Corners {
  glm::dvec3 a, b, c;
};

Corners corners_of(const Mesh& mesh, const glm::uvec3& triangle) {
  return {mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z]};
}

bool is_degenerate(const Mesh& mesh, const glm::uvec3& triangle) {
  if (triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x) return true;
  const Corners t = corners_of(mesh, triangle);
  glm::dvec3 e1 = t.b - t.a;
  glm::dvec3 e2 = t.c - t.a;
  // Scaled by the largest component first, so that neither huge nor tiny squares over- or
  // underflow.
  const double size = std::max({std::abs(e1.x), std::abs(e1.y), std::abs(e1.z), std::abs(e2.x),
                                std::abs(e2.y), std::abs(e2.z)});
  if (size == 0) return true;
  e1 /= size;
  e2 /= size;
  const glm::dvec3 e3 = e2 - e1;
  const double longest_squared = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e3, e3)});
  return glm::length(glm::cross(e1, e2)) <= flat_ratio * longest_squared;
}

}  // namespace

Bounds bounds_of(const Mesh& mesh) {
  Bounds bounds;
  for (const glm::dvec3& p : mesh.positions) bounds.extend(p);
  return bounds;
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const Corners t = corners_of(mesh, triangle);
    sum += 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
  }
  return sum;
}

double signed_volume_of(const Mesh& mesh) {
  if (mesh.positions.empty()) return 0;
  // Measured from a vertex, so that a body far from the origin keeps its precision.
  const glm::dvec3 from = mesh.positions.front();
  double sum = 0;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const Corners t = corners_of(mesh, triangle);
    sum += glm::dot(t.a - from, glm::cross(t.b - from, t.c - from)) / 6.0;
  }
  return sum;
}

void flip(Mesh& mesh) {
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
}

void append(Mesh& to, const Mesh& from) {
  if (from.positions.empty()) return;
  const bool with_uv = !to.texture_uv.empty() || !from.texture_uv.empty();
  const auto first = static_cast<uint32_t>(to.positions.size());
  if (with_uv) {
    to.texture_uv.resize(to.positions.size(), glm::vec2(0));
    to.texture_uv.insert(to.texture_uv.end(), from.texture_uv.begin(), from.texture_uv.end());
  }
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  if (with_uv) to.texture_uv.resize(to.positions.size(), glm::vec2(0));
  for (const glm::uvec3& triangle : from.triangles) to.triangles.push_back(triangle + first);
}

Mesh copies_of(const Mesh& mesh, std::span<const glm::dvec3> offsets) {
  Mesh out;
  out.positions.reserve(mesh.positions.size() * offsets.size());
  out.triangles.reserve(mesh.triangles.size() * offsets.size());
  out.texture_uv.reserve(mesh.texture_uv.size() * offsets.size());
  for (const glm::dvec3& offset : offsets) {
    const auto first = static_cast<uint32_t>(out.positions.size());
    for (const glm::dvec3& p : mesh.positions) out.positions.push_back(p + offset);
    for (const glm::uvec3& t : mesh.triangles) out.triangles.push_back(t + first);
    out.texture_uv.insert(out.texture_uv.end(), mesh.texture_uv.begin(), mesh.texture_uv.end());
  }
  return out;
}

void join_identical_vertices(Mesh& mesh) {
  const bool with_uv = !mesh.texture_uv.empty();
  const auto key = [&](uint32_t i) {
    const glm::dvec3& p = mesh.positions[i];
    const glm::vec2 uv = with_uv ? mesh.texture_uv[i] : glm::vec2(0);
    return std::make_tuple(p.x, p.y, p.z, uv.x, uv.y);
  };
  std::vector<uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
    const auto a = key(i), b = key(j);
    return a < b || (!(b < a) && i < j);
  });
  // `first_of[i]` is the lowest index with the value of vertex i: the vertex that stays.
  std::vector<uint32_t> first_of(order.size());
  for (size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && key(order[k]) == key(order[k - 1]);
    first_of[order[k]] = same ? first_of[order[k - 1]] : order[k];
  }
  std::vector<uint32_t> renumbered(order.size());
  uint32_t kept = 0;
  for (uint32_t i = 0; i < first_of.size(); ++i) {
    if (first_of[i] != i) {
      renumbered[i] = renumbered[first_of[i]];
      continue;
    }
    mesh.positions[kept] = mesh.positions[i];
    if (with_uv) mesh.texture_uv[kept] = mesh.texture_uv[i];
    renumbered[i] = kept++;
  }
  mesh.positions.resize(kept);
  if (with_uv) mesh.texture_uv.resize(kept);
  for (glm::uvec3& t : mesh.triangles) t = {renumbered[t.x], renumbered[t.y], renumbered[t.z]};
}

int64_t clean_mesh(Mesh& mesh) {
  const size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) { return is_degenerate(mesh, t); });
  return static_cast<int64_t>(before - mesh.triangles.size());
}

}  // namespace luxodus
