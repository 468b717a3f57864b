// Operations on whole meshes: measuring, joining, flipping, dropping degenerate triangles. Pure
// functions; any thread. Every function requires indices within `positions`.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

Bounds bounds_of(const Mesh& mesh);

/// Sum of the triangle areas [m2].
double area_of(const Mesh& mesh);

/// Enclosed volume [m3] of a closed mesh by the divergence theorem: positive where fronts look
/// outward.
double signed_volume_of(const Mesh& mesh);

/// Exchanges front and back of every triangle.
void flip(Mesh& mesh);

/// Adds the triangles of `from`. If only one of the two has texture coordinates, the other gets (0,
/// 0).
void append(Mesh& to, const Mesh& from);

/// The mesh once at each offset.
Mesh copies_of(const Mesh& mesh, std::span<const glm::dvec3> offsets);

/// Merges vertices of equal position and texture coordinate, in order of first appearance.
void join_identical_vertices(Mesh& mesh);

/// Drops triangles that repeat a vertex or have no area, keeps the order of the others, and returns
/// how many were dropped. Thin triangles stay if their height is above 1e-14 of the longest edge.
int64_t clean_mesh(Mesh& mesh);

}  // namespace luxodus
