// Imports meshes from Wavefront OBJ and glTF 2.0 files (.gltf, .glb), in a process of its own: a
// file that uses up memory or time is reported like any other problem. Positions are returned in
// metres with z up: node transforms, instances and default morph targets are applied, faces are
// triangulated, equal vertices joined, degenerate triangles dropped and counted.
//
// Not read, and told where they change what is lit: emission, transmission, skins, vertex colours,
// free-form surfaces. Not read: normals (the tracer uses flat triangles), cameras, pictures, points
// and lines. Files whose coordinates are in single precision are refused if they are so far from
// the origin that this costs a centimetre. Call from any thread; nothing is shared.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/result.hpp"
#include "scenes/light/geometry/mesh.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

class ReadingShare;

struct ImportedPart {
  std::string name;           // of the node or OBJ object; "#2", "#3" appended where names repeat
  std::string material_name;  // "" where the file gives none
  Mesh mesh;                  // texture coordinates where the file has them, v upwards
  std::optional<glm::dvec3>
      base_colour;                   // linear RGB in [0, 1]: glTF base colour, OBJ Kd as written
  std::optional<Problem> no_colour;  // why a named material has no colour, and where
  int64_t degenerate_triangles = 0;  // dropped here; a part without any valid triangle is omitted,
                                     // and its count goes to the first part
};

/// A lamp of a glTF (KHR_lights_punctual), placed.
struct ImportedLamp {
  std::string name;
  glm::dvec3 at{0}, direction{0, 0, -1};
  bool is_spot = false;                  // else it shines to all sides
  double candela = 0;                    // along `direction`, for white
  double inner_deg = 0, outer_deg = 45;  // half angles of a spot
  glm::dvec3 colour{1};                  // linear RGB in [0, 1]
};

/// What a mesh file holds besides its parts.
struct MeshExtras {
  std::vector<std::string> files;  // that were opened, for a hash of the scene
  std::vector<std::string> notes;  // what was not read, or read in a way that may surprise
  std::vector<ImportedLamp> lamps;
};

namespace limits {
/// Size of each file that an import opens [bytes]; reading takes about five times that in memory.
inline constexpr uint64_t mesh_file_bytes = 1ull << 30;
/// Limits for one import; an instance counts each time it is placed.
inline constexpr uint64_t mesh_vertices = 100'000'000;
inline constexpr uint64_t mesh_triangles = 100'000'000;
inline constexpr uint64_t mesh_parts = 1'000'000;
/// Nesting of a glTF's JSON (the format itself needs 6 levels), and depth of its node tree.
inline constexpr int gltf_nesting = 64;
inline constexpr int gltf_node_depth = 1000;
/// Largest step between neighbouring single-precision coordinates that is accepted [m].
inline constexpr double mesh_coordinate_step_m = 0.01;
/// Largest coordinate, which is that of places in a scene [m].
inline constexpr double mesh_coordinate_m = 1e7;
}  // namespace limits

/// Memory and time for reading a file of this size, in addition to the limits that hold for any
/// file: OBJ and glTF take about five times their size in memory, and a slow processor a second for
/// 10 MiB.
inline IsolatedLimits import_limits(uint64_t bytes) {
  return {16 * bytes, static_cast<uint32_t>(bytes >> 20)};
}

/// The extension of a file name in lower case: ".obj".
std::string mesh_ending(const std::string& path);

/// Returns one part per mesh and place in the file, in the file's order. `metres_per_unit` scales
/// the file's numbers (1 for glTF, which is in metres); `up` is the file's upward axis (glTF: y).
/// `extras`, if given, gets what else was found; a file of lamps alone then has no parts. `reading`
/// is told the progress.
/// Errors: a missing, oversized, unreadable or unknown file, an extension of glTF that a file
/// requires and that is not read, no triangles, a coordinate or colour that is not a number, more
/// than the limits.
Result<std::vector<ImportedPart>> import_mesh(const std::string& path, double metres_per_unit,
                                              UpAxis up, MeshExtras* extras = nullptr,
                                              ReadingShare* reading = nullptr);

}  // namespace luxodus
