// Cuts a closed mesh along a plane and closes it again: whether a vertex is above, on or below the
// plane is decided once, and a cut edge has one new vertex for both of its triangles, so that a
// plane through vertices and along edges opens no crack. Also the triangles of a flat face with
// holes. Pure functions; any thread.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

namespace limits {
/// Points of a face with its holes: cutting ears takes up to cubic time.
inline constexpr size_t face_points = 2'000;
}  // namespace limits

/// The points p with dot(normal, p) <= offset. `normal` has length 1.
struct HalfSpace {
  glm::dvec3 normal{0, 0, 1};
  double offset = 0;

  HalfSpace complement() const { return {-normal, -offset}; }
};

/// The part of a closed mesh within a half space; vertices within `on_plane` of the plane are on
/// it. The mesh itself if all of it is within; an empty one if nothing is. Nothing if the mesh is
/// not closed where it is cut, or the cut face cannot be filled.
std::optional<Mesh> cut(const Mesh& mesh, const HalfSpace& keep, double on_plane);

/// Triangles of a flat face: `rings` are its outer boundary, counter-clockwise, and its holes,
/// clockwise. Indices count the points of all rings in order. Nothing if rings cross.
std::optional<std::vector<glm::uvec3>> fill(std::span<const std::vector<glm::dvec2>> rings);

}  // namespace luxodus
