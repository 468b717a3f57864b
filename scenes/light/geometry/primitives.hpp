// Meshes of simple bodies from their dimensions, in double precision. Flat bodies are exact; each
// result for a round body states its largest distance from the true surface. Fronts face outward
// unless stated. Texture coordinates (quad, box, disc, sheets) run from 0 to 1, v upwards: v = 1 is
// the top row of a picture. Walls, stairs and extrusions: building_parts.hpp. Pure functions; any
// thread. Errors of all: a dimension that is not finite, not positive or beyond limits, named in
// the message; the caller, who knows the file and line, adds the place.
#pragma once

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

/// A body, and the largest distance between a point of the true surface and the mesh (0: exact).
struct Shape {
  Mesh mesh;
  double discretisation_bound_m = 0;
};

namespace limits {
/// A side or radius [m]: larger than any site; squares and volumes stay far from overflow.
inline constexpr double shape_length_m = 1e7;
/// Segments around a circle. At 1 m radius 4096 segments are 3e-7 m off, about the precision of
/// float.
inline constexpr int shape_segments = 4096;
/// Splits per side of a quad: 2 * 1024^2 triangles.
inline constexpr int quad_splits = 1024;
/// Parts of an icosahedron's edge; 20 * 256^2 = 1.3 million triangles, 4e-6 radii off.
inline constexpr int sphere_frequency = 256;
}  // namespace limits

namespace shapes {

enum class Caps { both, none };
enum class BoxAt { centre, corner };  // the origin is the box's centre, or its low corner

/// The parallelogram corner, corner + edge_u, ...; front towards cross(edge_u, edge_v). Split nu x
/// nv, two triangles each. Errors: also where the edges are parallel.
Result<Shape> quad(const glm::dvec3& corner, const glm::dvec3& edge_u, const glm::dvec3& edge_v,
                   int nu = 1, int nv = 1);

/// Twelve triangles; each face has its own vertices, so that a picture covers it. Seen from
/// outside, side faces have v along +z; top and bottom have v along +y.
Result<Shape> box(const glm::dvec3& size, BoxAt at = BoxAt::centre);

/// The inside of a box from the origin to `size`; each face may become an object of its own.
struct Room {
  Mesh floor, ceiling;  // z = 0, z = size.z
  Mesh x0, x1, y0, y1;  // walls at x = 0, x = size.x, y = 0, y = size.y

  Mesh all() const;
};
Result<Room> room(const glm::dvec3& size);

/// A cylinder about +z from z = 0 to `height`. Ring vertices lie on the true cylinder.
Result<Shape> cylinder(double radius, double height, int segments, Caps caps = Caps::both);

/// A disc in the plane z = 0 about the origin, front towards +z. The picture's square circumscribes
/// it.
Result<Shape> disc(double radius, int segments);

/// A pipe about +z from z = 0 to `length`: outside, bore (facing the axis) and both ring-shaped
/// ends. Requires: 0 < inner_radius < outer_radius.
Result<Shape> tube(double outer_radius, double inner_radius, double length, int segments);

/// A sphere about the origin: an icosahedron, its faces split just enough to stay within
/// `mesh_tolerance_m` of the true sphere. Vertices lie on the sphere, so the body is slightly
/// small.
Result<Shape> sphere(double radius, double mesh_tolerance_m);

/// Least number of segments, 3 or more, that keeps a circle's chords within `mesh_tolerance_m` of
/// its arc. Errors: also where that exceeds limits::shape_segments.
Result<int> segments_within(double radius, double mesh_tolerance_m);

/// Largest distance of arc and chord (the sagitta) of a circle of `segments` chords [m].
double sagitta(double radius, int segments);

}  // namespace shapes
}  // namespace luxodus
