#include "scenes/formats/fds_input/bodies.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenes/light/geometry/primitives.hpp"

namespace luxodus::fds_input {

namespace {

/// Share of a radius by which chords may deviate: a circle of 63 segments.
constexpr double round_tolerance = 1.25e-3;

const char* const instead =
    "give its surface as VERTS and FACES, or import it as OBJ or glTF in the scene";

glm::dvec3 vector_of(GroupKeys& keys, std::string_view key, const glm::dvec3& otherwise) {
  const std::vector<double> v = keys.array(key, {otherwise.x, otherwise.y, otherwise.z});
  return {v[0], v[1], v[2]};
}

/// Sorts triangles by the surface that each names; `verts`: x, y, z of each vertex.
void faces_of(GroupKeys& keys, std::vector<Mesh>& meshes, size_t most) {
  const std::vector<double> verts = keys.numbers("VERTS");
  const std::vector<double> faces = keys.numbers("FACES");
  constexpr size_t per_face = 4;  // three vertices and the number of a surface
  if (verts.empty() || verts.size() % 3 != 0)
    return keys.fail("VERTS", "VERTS of &GEOM are not three coordinates each");
  if (faces.empty() || faces.size() % per_face != 0)
    return keys.fail("FACES", "FACES of &GEOM are not three vertices and a surface each");
  if (faces.size() / per_face > most)
    return keys.fail("FACES", fmt::format("more than {} triangles", most));
  for (const double v : verts)
    if (!(std::abs(v) <= limits::farthest_m))
      return keys.fail("VERTS", "a vertex of &GEOM is beyond 1000 km");
  std::vector<glm::dvec3> points(verts.size() / 3);
  for (size_t i = 0; i < points.size(); ++i)
    points[i] = {verts[3 * i], verts[3 * i + 1], verts[3 * i + 2]};
  for (size_t f = 0; f < faces.size(); f += per_face) {
    glm::uvec3 corners;
    for (int k = 0; k < 3; ++k) {
      const double n = faces[f + static_cast<size_t>(k)];
      if (!(n >= 1 && n <= static_cast<double>(points.size()) && n == std::floor(n)))
        return keys.fail("FACES", fmt::format("a face of &GEOM has the vertex {:g}, there are {}",
                                              n, points.size()));
      corners[k] = static_cast<uint32_t>(n) - 1;
    }
    // FDS reads 0 as its default surface; with none in the list, the first one is taken.
    const double surface = faces[f + 3];
    if (!(surface >= 0 && surface <= static_cast<double>(meshes.size()) &&
          surface == std::floor(surface)))
      return keys.fail("FACES", fmt::format("a face of &GEOM has the surface {:g}, there are {}",
                                            surface, meshes.size()));
    Mesh& mesh = meshes[surface < 1 ? 0 : static_cast<size_t>(surface) - 1];
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(points[corners[k]]);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
}

/// Adds a solid as a mesh, moved by `place`.
template <class Place>
void solid(GroupKeys& keys, std::string_view key, const Result<Shape>& shape, Mesh& out,
           const Place& place) {
  if (!shape) return keys.fail(key, shape.problem().what);
  out = shape->mesh;
  for (glm::dvec3& p : out.positions) p = place(p);
  out.texture_uv.clear();
}

/// A cylinder about its middle, along its axis.
void cylinder_of(GroupKeys& keys, Mesh& out) {
  const glm::dvec3 middle = vector_of(keys, "CYLINDER_ORIGIN", glm::dvec3(0));
  const glm::dvec3 axis = vector_of(keys, "CYLINDER_AXIS", glm::dvec3(0, 0, 1));
  const double radius = keys.number("CYLINDER_RADIUS", 0);
  const double length = keys.number("CYLINDER_LENGTH", 0);
  constexpr double shortest = 1e-9;
  if (!(glm::length(axis) > shortest))
    return keys.fail("CYLINDER_AXIS", "CYLINDER_AXIS of &GEOM has no length");
  const auto segments = shapes::segments_within(radius, round_tolerance * radius);
  if (!segments) return keys.fail("CYLINDER_RADIUS", segments.problem().what);
  const glm::dvec3 w = glm::normalize(axis);
  const glm::dvec3 aside = std::abs(w.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(aside, w));
  const glm::dvec3 v = glm::cross(w, u);
  solid(keys, "CYLINDER_LENGTH", shapes::cylinder(radius, length, segments.value()), out,
        [&](const glm::dvec3& p) { return middle + p.x * u + p.y * v + (p.z - length / 2) * w; });
}

}  // namespace

Body body_of(GroupKeys& keys, size_t surfaces, size_t most) {
  for (const char* key : {"BINARY_FILE", "READ_BINARY", "ZVALS", "POLY", "EXTRUDE"})
    keys.refuse(key, instead);
  Body out;
  out.meshes.resize(std::max<size_t>(surfaces, 1));
  if (keys.has("VERTS") || keys.has("FACES")) {
    faces_of(keys, out.meshes, most);
  } else if (keys.has("SPHERE_ORIGIN") || keys.has("SPHERE_RADIUS")) {
    const glm::dvec3 middle = vector_of(keys, "SPHERE_ORIGIN", glm::dvec3(0));
    const double radius = keys.number("SPHERE_RADIUS", 0);
    solid(keys, "SPHERE_RADIUS", shapes::sphere(radius, round_tolerance * radius),
          out.meshes.front(), [&](const glm::dvec3& p) { return middle + p; });
  } else if (keys.has("CYLINDER_ORIGIN") || keys.has("CYLINDER_RADIUS")) {
    cylinder_of(keys, out.meshes.front());
  } else if (const auto box = keys.box("XB")) {
    solid(keys, "XB", shapes::box(box->high - box->low, shapes::BoxAt::corner), out.meshes.front(),
          [&](const glm::dvec3& p) { return box->low + p; });
  } else {
    keys.fail("ID", std::string("this &GEOM has neither VERTS and FACES nor a sphere, a cylinder "
                                "or a box: ") +
                        instead);
  }
  return out;
}

}  // namespace luxodus::fds_input
