// Smoke and flame fields from files, as a data-set medium: NRRD (.nrrd, .nhdr with its data file)
// with raw encoding, and VTK XML image data (.vti): ascii, inline base64, appended raw or base64,
// not compressed. Fields by name: `extinction` [1/m], `soot_density` [kg/m3], `albedo` [0, 1],
// `emission` (relative).
//
// Nothing is resampled: NRRD samples become cells about their points; VTK point values become cells
// by the mean of the eight corners, which is the mean of the trilinear field over the cell. Every
// size a file claims is checked against the bytes it has before memory is taken. Any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/medium.hpp"

namespace luxodus {

namespace limits {
inline constexpr uint64_t data_set_cells = 1ull << 31;  // 8 GiB per field
inline constexpr uint64_t data_set_side = 1ull << 20;
inline constexpr size_t nrrd_header_bytes = 64 * 1024;
/// A mean free path of a nanometre [1/m]. Solid soot, 1800 kg/m3 of 8700 m2/kg, would have 1.6e7:
/// what says more than 1e9 is damaged or in other units.
inline constexpr float extinction_per_m = 1e9f;
/// A .vti file is held whole while it is read.
inline constexpr uint64_t vti_file_bytes = 16ull << 30;
}  // namespace limits

struct DataSetOptions {
  /// Turns soot density into extinction; 8700 m2/kg at 633 nm for flaming fires (Mulholland and
  /// Croarkin 2000), smouldering must state its own. None: nobody has stated it.
  std::optional<double> mass_extinction_m2_per_kg = 8700;
  /// What the array of a 3-D NRRD is, unless the file says `field:=name`.
  std::string field = "extinction";
};

struct LoadedDataSet {
  DataSet data;                         // arrays the file does not have are empty
  glm::dvec3 origin{0};                 // low corner of the box, in the file's coordinates [m]
  glm::dvec3 spacing{0};                // edges of a cell [m]
  std::vector<std::string> files_read;  // for a hash of the scene
  /// The file has soot, and no mass extinction was stated: what `data` has as extinction is its
  /// density.
  bool lacks_mass_extinction = false;
};

/// Reads by the file's ending. NRRD also gives several fields in one file: four dimensions, the
/// fields along the first, named by `fields:=a b c`; 8-bit samples are mapped to [old min, old max]
/// where stated. Errors, with the line where the file has lines: what is not this format, more or
/// fewer values than claimed, negative, infinite or undefined values (with their cell), albedo
/// above 1, extinction above limits::extinction_per_m, no known field, a grid that is turned or
/// mirrored, more than the limits.
Result<LoadedDataSet> read_data_set(const std::string& path, const DataSetOptions& options = {});

}  // namespace luxodus
