// The index of a fire simulation, the .smv file of FDS (NIST). It names meshes with their nodes,
// obstructions and openings, and the files of results. Only those that this program can use are
// listed, and none is opened here. Coordinates are absolute [m], times [s]. Any thread.
//
// Format: FDS User's Guide (NIST SP 1019), chapter on output file formats, and files of FDS 6.7 and
// 6.9. A keyword stands in column 1, its data on lines that begin with a blank; others are skipped.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus::fds {

namespace limits {
/// An index of a large building has 10^5 lines, 10 MB.
inline constexpr uint64_t index_bytes = uint64_t{256} << 20;
inline constexpr size_t meshes = 4096;
/// Cells along one side of a mesh, and cells of a mesh: 1 GB of node values in a frame.
inline constexpr int side_cells = 8192;
inline constexpr int64_t mesh_cells = int64_t{1} << 28;
/// Species in labels of files: a fire has a few that absorb light.
inline constexpr size_t species = 100;
/// Times that a run was restarted.
inline constexpr size_t restarts = 1000;
}  // namespace limits

/// Cells low..high-1 of a mesh, by node number.
struct NodeBox {
  glm::ivec3 low{0};
  glm::ivec3 high{0};
};

/// Name of an obstruction, the surface of most of its sides (index in Case::surfaces), and how it
/// is displayed if not like its surface.
struct ObstructionLabel {
  std::string name;
  size_t surface = 0;
  std::optional<glm::dvec3> rgb;  // encoded sRGB, 0 to 1
  std::optional<double> opacity;
};

/// A face of a mesh that is open to the ambient, as a box without thickness [m].
struct Opening {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
};

struct Surface {
  std::string name;
  glm::dvec3 rgb{0.5};  // what Smokeview shows, encoded sRGB, 0 to 1
  double opacity = 1;
};

struct Mesh {
  std::string name;
  glm::ivec3 cells{0};
  std::array<std::vector<double>, 3> nodes;  // by axis, ascending, one more than cells [m]
  std::vector<NodeBox> obstructions;         // snapped to the grid; in the order of the index
  std::vector<ObstructionLabel> labels;      // one for each obstruction
  std::vector<Opening> openings;
  int line = 0;

  glm::dvec3 low() const { return {nodes[0].front(), nodes[1].front(), nodes[2].front()}; }
  glm::dvec3 high() const { return {nodes[0].back(), nodes[1].back(), nodes[2].back()}; }
  size_t cell_count() const {
    return static_cast<size_t>(cells.x) * static_cast<size_t>(cells.y) *
           static_cast<size_t>(cells.z);
  }
  glm::ivec3 node_counts() const { return cells + 1; }
  size_t node_count() const {
    const glm::ivec3 n = node_counts();
    return static_cast<size_t>(n.x) * static_cast<size_t>(n.y) * static_cast<size_t>(n.z);
  }
};

/// Whether faces of this SURF_ID are planes behind which the building goes on.
constexpr bool is_symmetric(std::string_view surface) {
  return surface == "MIRROR" || surface == "PERIODIC" || surface == "PERIODIC FLOW ONLY";
}

/// A release of FDS, "6.11".
struct Release {
  int major = 0, minor = 0;
};

/// An obstruction that appears or vanishes.
struct Change {
  size_t mesh = 0;
  size_t obstruction = 0;
  double time_s = 0;
  bool appears = false;
  int line = 0;
};

enum class Quantity { extinction, density, optical_density, heat_release, visibility, other };

/// What a file holds. FDS names a species before a quantity that is one's: "SOOT DENSITY".
struct Output {
  Quantity quantity = Quantity::other;
  std::string species;  // of extinctions, densities and optical densities

  friend bool operator==(const Output&, const Output&) = default;
};

/// The species of FDS that absorbs light without being told so.
inline constexpr const char* soot = "SOOT";

/// A slice; flat ones only of visibility. Values are of nodes, or of cells: value (i, j, k) is then
/// that of the cell below the node (i, j, k) on every axis.
struct Slice {
  size_t mesh = 0;
  bool of_cells = false;
  Output output;
  NodeBox nodes;  // first and last
  std::filesystem::path file;
  int line = 0;
};

/// Bytes of nodes, run-length encoded.
struct Smoke3d {
  size_t mesh = 0;
  Output output;
  std::filesystem::path file;
  int line = 0;
};

/// Five quantities at all nodes at one time.
struct Plot3d {
  size_t mesh = 0;
  double time_s = 0;
  std::array<Output, 5> outputs;
  std::filesystem::path file;
  int line = 0;
};

struct Case {
  std::string file;  // the index
  std::filesystem::path folder;
  std::string version;  // as stated in the index
  std::optional<Release> release;
  std::vector<Mesh> meshes;
  std::vector<Surface> surfaces;
  size_t default_surface = 0;  // used by faces of meshes
  /// By time; without those that a restart made void.
  std::vector<Change> changes;
  std::vector<Slice> slices;      // solid ones
  std::vector<Slice> visibility;  // solid and flat ones
  std::vector<Smoke3d> smoke;
  std::vector<Plot3d> plots;
  /// Describes what the case has that is not read; "" where nothing.
  std::string unread;
  std::optional<std::filesystem::path> heat_release_file;  // CASE_hrr.csv
  /// By species: the mass extinction coefficients of Smoke3D [m2/kg], where above zero.
  std::map<std::string, double> mass_extinction_m2_per_kg;
  /// Species whose extinction, optical density or visibility any file holds, and those whose
  /// density one holds, in files that are read and in others.
  std::vector<std::string> absorbing, dense;
  /// HRRPUV of the highest byte of Smoke3D [kW/m3].
  double highest_heat_kw_m3 = 1200;
  /// What the user should know about it: times that go back.
  std::vector<std::string> notes;
  /// What its building lacks: bodies that are left out, planes of symmetry.
  std::vector<std::string> building_notes;
};

/// Errors, with their line: not an index of FDS; a mesh without its nodes, nodes that do not
/// ascend; malformed numbers; a file of results outside the folder of the index; more than the
/// limits; a known quantity in another unit than that of FDS.
Result<Case> read_case(const std::filesystem::path& index);

}  // namespace luxodus::fds
