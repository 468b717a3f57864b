// Meshes from files of other programs: Wavefront OBJ and glTF 2.0 (.gltf, .glb), read through
// Assimp, which appears in assimp_import.cpp only and runs in a process of its own: a file that
// makes it crash, or take all memory or time, is a problem like any other. Positions come out in
// metres with z up, node transforms applied, faces cut into triangles, equal vertices joined,
// degenerate triangles dropped and counted.
//
// Not read: normals (flat triangles are what is traced), lights, cameras, pictures, animation,
// points and lines. Assimp keeps coordinates in single precision: files whose coordinates are so
// far from their origin that this costs a centimetre are refused. Call from any thread; nothing is
// shared.
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
  std::optional<Problem> no_colour;  // why there is none of a material that is named, and where
  int64_t degenerate_triangles = 0;  // dropped; those of parts that had no others go to the first
};

namespace limits {
/// Of each file that an import opens [bytes]; Assimp takes about five times that in memory.
inline constexpr uint64_t mesh_file_bytes = 1ull << 30;
/// Of one import, instances counted each time they are placed.
inline constexpr uint64_t mesh_vertices = 100'000'000;
inline constexpr uint64_t mesh_triangles = 100'000'000;
inline constexpr uint64_t mesh_parts = 1'000'000;
/// Objects and groups of an OBJ: Assimp looks each up among all, which took 54 s for 200 000.
inline constexpr uint64_t obj_groups = 50'000;
/// Of the JSON of a glTF, whose own words nest 6 deep; and of its tree of nodes. Assimp follows
/// both by recursion.
inline constexpr int gltf_nesting = 64;
inline constexpr int gltf_node_depth = 1000;
/// Largest step between neighbouring single-precision coordinates that is accepted [m].
inline constexpr double mesh_coordinate_step_m = 0.01;
}  // namespace limits

/// What reading a file of so many bytes may take beyond what all reading takes: OBJ and glTF take
/// about five times their size, and a slow processor a second for 10 MiB.
inline IsolatedLimits import_limits(uint64_t bytes) {
  return {16 * bytes, static_cast<uint32_t>(bytes >> 20)};
}

/// One part per mesh and place in the file, in the file's order. `metres_per_unit` scales the
/// file's numbers (1 for glTF, which is in metres); `up` is the file's upward axis (glTF: y).
/// `files_read`, where given, gets the path of every file that was opened, for a hash of the scene;
/// `reading` hears how far it is.
/// Errors: a missing, oversized, unreadable or unknown file, no triangles, a coordinate or colour
/// that is not a number (by part and vertex), more than the limits.
Result<std::vector<ImportedPart>> import_mesh(const std::string& path, double metres_per_unit,
                                              UpAxis up,
                                              std::vector<std::string>* files_read = nullptr,
                                              ReadingShare* reading = nullptr);

}  // namespace luxodus
