// Whether a mesh is closed: whether each of its edges belongs to an even number of triangles, as
// the boundary of a solid must. Pure functions; any thread.
#pragma once

#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

namespace limits {
/// Open edges that are searched for others along them; with more, only whole edges match.
inline constexpr size_t split_edges = 4'000;
}  // namespace limits

/// Vertices nearer than this are one [m]: shapes come in single precision.
inline constexpr double one_vertex_m = 1e-4;

struct OpenEdges {
  size_t edges = 0;
  /// Of the faces that would close the mesh, were they flat [m2].
  double area_m2 = 0;

  bool closed() const { return edges == 0; }
};

/// Edges of an odd number of triangles. An edge along which several others lie matches them.
/// Requires: indices within `positions`.
OpenEdges open_edges(const Mesh& mesh);

}  // namespace luxodus
