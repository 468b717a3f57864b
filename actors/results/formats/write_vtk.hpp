// Writes results for ParaView and other programs that read VTK's XML files: surfaces as PolyData
// (.vtp), volumes as ImageData (.vti), values per cell. Raw appended binary, UInt64 sizes, little
// endian, file version 1.0 (VTK User's Guide, "VTK XML file formats"). Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Limit on cells or points of a file: readers with 32-bit indices end at 2^31 - 1.
inline constexpr uint64_t max_vtk_cells = (uint64_t{1} << 31) - 1;
}  // namespace limits

/// One value, or `components` values side by side, for every cell. NaN is allowed: ParaView shows
/// it as "no value".
struct VtkArray {
  std::string name;  // unique in its file, without blanks; its unit last: "illuminance_lx"
  int components = 1;
  std::variant<std::vector<float>, std::vector<double>, std::vector<int32_t>, std::vector<int64_t>>
      values;
};

struct VtkSurface {
  std::string comment;                     // the comment at the top of the file
  std::vector<glm::dvec3> points;          // [m], finite
  std::vector<glm::uvec3> triangles;       // indices of points
  std::vector<VtkArray> cell_data;         // per triangle
  std::vector<std::string> surface_names;  // by the number that a cell's "surface" has
};

struct VtkVolume {
  std::string comment;
  glm::dvec3 origin{0};             // low corner [m]
  glm::dvec3 spacing{1};            // edges of a voxel [m], > 0
  std::array<int, 3> cells{};       // voxels along x, y, z, > 0; x runs fastest in the arrays
  std::vector<VtkArray> cell_data;  // per voxel
};

/// Errors: an array of the wrong length or without a unique name, or with one that has blanks or
/// brackets, an index out of range, a coordinate that is not finite; else as write_file_atomically.
Result<void> write_vtp(const std::filesystem::path& path, const VtkSurface& surface);
Result<void> write_vti(const std::filesystem::path& path, const VtkVolume& volume);

}  // namespace luxodus
