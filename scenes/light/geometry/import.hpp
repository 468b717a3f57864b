// Imports meshes from Wavefront OBJ and glTF 2.0 files (.gltf, .glb) through Assimp. Assimp appears
// in assimp_import.cpp only and runs in a process of its own: a file that makes it crash, or use up
// memory or time, is reported like any other problem. Positions are returned in metres with z up:
// node transforms are applied, faces are triangulated, equal vertices joined, degenerate triangles
// dropped and counted.
//
// Not read: normals (the tracer uses flat triangles), lights, cameras, pictures, animation, points
// and lines. Assimp keeps coordinates in single precision: files are refused if their coordinates
// are so far from the origin that this costs a centimetre. Call from any thread; nothing is shared.
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

namespace limits {
/// Size of each file that an import opens [bytes]; Assimp takes about five times that in memory.
inline constexpr uint64_t mesh_file_bytes = 1ull << 30;
/// Limits for one import; an instance counts each time it is placed.
inline constexpr uint64_t mesh_vertices = 100'000'000;
inline constexpr uint64_t mesh_triangles = 100'000'000;
inline constexpr uint64_t mesh_parts = 1'000'000;
/// Objects and groups of an OBJ: Assimp searches all of them for each, which took 54 s for 200 000.
inline constexpr uint64_t obj_groups = 50'000;
/// Nesting of a glTF's JSON (the format itself needs 6 levels), and depth of its node tree. Assimp
/// processes both recursively.
inline constexpr int gltf_nesting = 64;
inline constexpr int gltf_node_depth = 1000;
/// Largest step between neighbouring single-precision coordinates that is accepted [m].
inline constexpr double mesh_coordinate_step_m = 0.01;
}  // namespace limits

/// Memory and time for reading a file of this size, in addition to the limits that hold for any
/// file: OBJ and glTF take about five times their size in memory, and a slow processor a second for
/// 10 MiB.
inline IsolatedLimits import_limits(uint64_t bytes) {
  return {16 * bytes, static_cast<uint32_t>(bytes >> 20)};
}

/// Returns one part per mesh and place in the file, in the file's order. `metres_per_unit` scales
/// the file's numbers (1 for glTF, which is in metres); `up` is the file's upward axis (glTF: y).
/// If given, `files_read` gets the path of every file that was opened, for a hash of the scene, and
/// `reading` is told the progress.
/// Errors: a missing, oversized, unreadable or unknown file, no triangles, a coordinate or colour
/// that is not a number (by part and vertex), more than the limits.
Result<std::vector<ImportedPart>> import_mesh(const std::string& path, double metres_per_unit,
                                              UpAxis up,
                                              std::vector<std::string>* files_read = nullptr,
                                              ReadingShare* reading = nullptr);

}  // namespace luxodus
