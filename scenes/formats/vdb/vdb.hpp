// Smoke from OpenVDB files (.vdb): the grids that a file has, and one of them as even cells. A
// program of its own reads the file, because its library is large and may be absent; it has limits
// on memory and time. Floats that are a fog volume are read: sparse cells of which those that the
// file does not say are 0. An index of the file is the middle of a cell. Plain values; any thread.
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
/// Of a file [bytes].
inline constexpr uint64_t vdb_bytes = uint64_t{4} << 30;
inline constexpr size_t vdb_grids = 1000;
/// Of the box around the smoke of a grid: 512 MiB of floats.
inline constexpr uint64_t vdb_cells = uint64_t{1} << 27;
}  // namespace limits

struct VdbGrid {
  std::string name;
  std::string type;    // of its values: "float"
  std::string kind;    // "fog volume", "level set", "unknown", ...
  uint64_t cells = 0;  // that have a value of their own
  std::string fault;   // why it cannot be read; "" where it can
};

/// Cells from the low corner, x fastest, then y. Axes of the scene: z up.
struct VdbSmoke {
  uint64_t nx = 0, ny = 0, nz = 0;
  glm::dvec3 origin{0};   // low corner, in units of the file
  glm::dvec3 spacing{0};  // edges of a cell, in units of the file
  std::vector<float> values;
};

/// Who reads.
struct VdbProgram {
  std::filesystem::path path;                   // luxodus_vdb, of the same build
  std::function<void(double share)> told = {};  // how far it is, where somebody wants to hear
  /// What it may take for a question; otherwise what the size of the file allows.
  std::optional<uint32_t> processor_s = {};
  std::optional<uint64_t> memory_bytes = {};
};

/// The grids of a file.
/// Errors: no such program, one of another build, no OpenVDB file, damaged, more than the limits.
Result<std::vector<VdbGrid>> list_vdb(const std::filesystem::path& file, const VdbProgram& program);

/// The grid of this name. `up`: the file's upward axis.
/// Errors: as list_vdb; no such grid, and those there are; values that are no floats; a level set;
/// axes that are turned, mirrored or bent; a background that is not 0; no values; more cells than
/// the limit; a value that is negative or no number, with its index.
Result<VdbSmoke> read_vdb(const std::filesystem::path& file, const std::string& grid, UpAxis up,
                          const VdbProgram& program);

}  // namespace luxodus
