// The building of an FDS input file: meshes, obstructions, holes, openings, surfaces and bodies of
// triangles, multiplied as &MULT says, including the files that &CATF names. A key that changes
// geometry and is not supported is rejected by its name. Coordinates are those of the file [m].
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
/// Size of an input file and of each that it names; public ones have at most about 20 MB.
inline constexpr uint64_t fds_input_bytes = uint64_t{128} << 20;
/// Number of files that &CATF names.
inline constexpr size_t fds_input_files = 200;
/// Boxes of one kind after &MULT: obstructions, holes, openings.
inline constexpr size_t fds_input_boxes = 200'000;
/// Pairs of boxes that are compared: about 10 s. 20 000 obstructions with 2000 holes have 4e7.
inline constexpr uint64_t fds_input_pairs = 1'000'000'000;
/// Triangles of all &GEOM.
inline constexpr size_t fds_input_triangles = 4'000'000;
}  // namespace limits

/// Whether an object exists over time, driven by &DEVC and &CTRL.
struct FdsCourse {
  bool at_start = true;
  std::vector<double> turns_s;  // when the state changes, ascending
  /// The driver where it is no clock: "the device \"heat\"". The object then stays as at the start.
  std::string driven_by;

  bool at(double time_s) const {
    bool there = at_start;
    for (const double turn : turns_s) there = time_s > turn ? !there : there;
    return there;
  }
};

/// How users name an object.
struct FdsTitle {
  std::string name;    // its ID; "" without one
  std::string handle;  // its ID, else "line 12"
};

struct FdsInputMesh {
  std::string name;
  fds_input::Box box;
  glm::ivec3 cells{10};
  int line = 0;
};

struct FdsInputSurface {
  std::string name;
  glm::dvec3 rgb{1, 0.8, 0.4};  // the default of FDS
  double opacity = 1;           // "TRANSPARENCY" of FDS: 1 is opaque
};

struct FdsObstruction {
  FdsTitle title;
  fds_input::Box box;
  size_t surface = 0;             // that of most of its sides
  std::optional<glm::dvec3> rgb;  // its own colour
  double opacity = 1;
  bool permit_hole = true, thicken = false;
  FdsCourse course;
};

struct FdsHole {
  FdsTitle title;
  fds_input::Box box;
  FdsCourse course;  // when the opening exists
};

/// An opening to the outside, in a face of a mesh: a plane.
struct FdsOpening {
  FdsTitle title;
  fds_input::Box box;
  /// The face, where &VENT names a whole face of each mesh (MB): 0 to 5, low x, high x, low y...
  std::optional<int> mesh_face;
  FdsCourse course;
};

/// A body of triangles with one surface.
struct FdsBody {
  std::string name;
  size_t surface = 0;
  std::optional<glm::dvec3> rgb;
  double opacity = 1;
  Mesh mesh;
};

struct FdsInput {
  std::string file, case_name;  // CHID: the prefix of the files of results
  std::optional<double> end_s;  // T_END
  /// The first line that stretches a grid; meshes then have other cells than their `cells`.
  std::optional<SourcePlace> stretched;
  std::vector<FdsInputMesh> meshes;
  std::vector<FdsInputSurface> surfaces;
  size_t default_surface = 0;
  std::vector<FdsObstruction> obstructions;
  std::vector<FdsHole> holes;
  std::vector<FdsOpening> openings;
  std::vector<FdsBody> bodies;
  std::vector<std::string> notes;  // what the user should know about it
};

/// Errors, with file and line: those of namelist.hpp; a value of the wrong type; a &MULT, &MOVE,
/// &SURF, &DEVC or &CTRL that does not exist; a file of &CATF outside the folder of `file`, unless
/// it has nothing of a building, or one named by another such file; cylindrical meshes, bodies from
/// binary files (BINARY_FILE), terrain (ZVALS), extruded polygons (POLY), obstructions with a SHAPE
/// or turned off the axes; no mesh; more than the limits.
Result<FdsInput> read_fds_input(const std::filesystem::path& file);

}  // namespace luxodus
