// Reads smoke from OpenVDB files (.vdb): lists the grids of a file, and reads one as even cells. A
// separate program reads the file, because its library is large and may be absent; it has limits on
// memory and time. Grids of floats that are a fog volume are read; cells that the file omits are 0.
// An index of the file is the centre of a cell. Plain values; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

namespace limits {
/// Size of a file [bytes].
inline constexpr uint64_t vdb_bytes = uint64_t{4} << 30;
inline constexpr size_t vdb_grids = 1000;
/// Cells of the box around the smoke of a grid: 512 MiB of floats.
inline constexpr uint64_t vdb_cells = uint64_t{1} << 27;
}  // namespace limits

struct VdbGrid {
  std::string name;
  std::string type;    // of its values: "float"
  std::string kind;    // "fog volume", "level set", "unknown", ...
  uint64_t cells = 0;  // active cells
  std::string fault;   // why it cannot be read; "" where it can
};

/// Cells from the low corner, x fastest, then y. Axes of the scene: z up.
struct VdbSmoke {
  uint64_t nx = 0, ny = 0, nz = 0;
  glm::dvec3 origin{0};   // low corner, in units of the file
  glm::dvec3 spacing{0};  // edges of a cell, in units of the file
  std::vector<float> values;
};

/// The program that reads.
struct VdbProgram {
  std::filesystem::path path;                   // luxodus_vdb, of the same build
  std::function<void(double share)> told = {};  // receives the progress, where given
  /// Processor time for a question; if absent, chosen by the file's size.
  std::optional<uint32_t> processor_s = {};
  std::optional<uint64_t> memory_bytes = {};
};

/// The grids of a file.
/// Errors: no such program, one of another build, no OpenVDB file, damaged, more than the limits.
Result<std::vector<VdbGrid>> list_vdb(const std::filesystem::path& file, const VdbProgram& program);

/// The grid of this name. `up`: the file's upward axis.
/// Errors: as list_vdb; no such grid, with a list of those that exist; values that are not floats;
/// a level set; axes that are rotated, mirrored or nonlinear; a background that is not 0; no
/// values; more cells than the limit; a negative or undefined value, with its index.
Result<VdbSmoke> read_vdb(const std::filesystem::path& file, const std::string& grid, UpAxis up,
                          const VdbProgram& program);

}  // namespace luxodus
