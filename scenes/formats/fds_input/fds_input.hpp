// What the input file of an FDS case says of its building: meshes, obstructions, holes, openings,
// surfaces and bodies of triangles, multiplied as &MULT says, with the files that &CATF names. What
// changes geometry and is not read is refused by its name. Coordinates are those of the file [m].
// Plain values; any thread.
//
// Semantics: FDS User's Guide (NIST SP 1019), chapter "Building the model", and FDS 6.9 itself.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/fds_input/boxes.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

namespace limits {
/// Of an input file and each that it names; public ones have at most some 20 MB.
inline constexpr uint64_t fds_input_bytes = uint64_t{128} << 20;
/// That &CATF names.
inline constexpr size_t fds_input_files = 200;
/// Boxes of one kind after &MULT: obstructions, holes, openings.
inline constexpr size_t fds_input_boxes = 200'000;
/// Pairs of boxes that are compared: some 10 s. 20 000 obstructions with 2000 holes have 4e7.
inline constexpr uint64_t fds_input_pairs = 1'000'000'000;
/// Triangles of all &GEOM.
inline constexpr size_t fds_input_triangles = 4'000'000;
}  // namespace limits

/// Whether something is there, over time: &DEVC and &CTRL drive it.
struct FdsCourse {
  bool at_start = true;
  std::optional<double> turns_s;  // when it becomes the opposite
  /// What drives it, where that is no clock: "the device \"heat\"". It is then as at the start.
  std::string driven_by;

  bool at(double time_s) const { return turns_s && time_s > *turns_s ? !at_start : at_start; }
};

struct FdsInputMesh {
  std::string name;
  fds_input::Box box;
  glm::ivec3 cells{10};
  int line = 0;
};

struct FdsInputSurface {
  std::string name;
  glm::dvec3 rgb{1, 0.8, 0.4};  // of FDS, unless said
  double opacity = 1;           // "TRANSPARENCY" of FDS: 1 is opaque
};

struct FdsObstruction {
  std::string name;
  fds_input::Box box;
  size_t surface = 0;             // of most of its sides
  std::optional<glm::dvec3> rgb;  // its own
  double opacity = 1;
  bool permit_hole = true, thicken = false;
  FdsCourse course;
};

struct FdsHole {
  fds_input::Box box;
  FdsCourse course;  // of the opening
  std::string name;
};

/// An opening to the outside, in a face of a mesh: a plane.
struct FdsOpening {
  std::string name;
  fds_input::Box box;
  /// Of each mesh by itself, where it stands for a whole face (MB): 0 to 5, low x, high x, low y...
  std::optional<int> mesh_face;
  FdsCourse course;
};

/// A body of triangles, of one surface.
struct FdsBody {
  std::string name;
  size_t surface = 0;
  std::optional<glm::dvec3> rgb;
  double opacity = 1;
  Mesh mesh;
};

struct FdsInput {
  std::string file, case_name;  // CHID: of the results' files
  std::vector<FdsInputMesh> meshes;
  std::vector<FdsInputSurface> surfaces;
  size_t default_surface = 0;
  std::vector<FdsObstruction> obstructions;
  std::vector<FdsHole> holes;
  std::vector<FdsOpening> openings;
  std::vector<FdsBody> bodies;
  std::vector<std::string> notes;  // what a person must know of it
};

/// Errors, with file and line: what namelist.hpp says; a key that is none of its type; a &MULT,
/// &SURF, &DEVC or &CTRL that is not there; a file of &CATF outside of the folder of `file`, or
/// within another such; stretched meshes (&TRNX...), cylindrical ones, bodies from binary files
/// (BINARY_FILE), terrain (ZVALS), extruded polygons (POLY), bodies that are moved (MOVE_ID),
/// obstructions of a SHAPE; no mesh; more than the limits.
Result<FdsInput> read_fds_input(const std::filesystem::path& file);

}  // namespace luxodus
