// Reads smoke and flame fields of a data-set medium: NRRD (.nrrd, .nhdr with its data file) with
// raw encoding, and VTK XML image data (.vti): ascii, inline base64, appended raw or base64, not
// compressed. The fields: `extinction` [1/m], `soot_density` [kg/m3], `albedo` [0, 1], `emission`
// (relative).
//
// Nothing is resampled: NRRD samples become cells centred on their points; VTK point values become
// cells by the mean of the eight corners, which is the mean of the trilinear field over the cell.
// Every size that a file declares is checked against its bytes before memory is allocated. Any
// thread.
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
/// A mean free path of a nanometre [1/m]. Solid soot, 1800 kg/m3 at 8700 m2/kg, would have 1.6e7:
/// values above 1e9 are damaged or in another unit.
inline constexpr float extinction_per_m = 1e9f;
/// A .vti file is held in memory while it is read.
inline constexpr uint64_t vti_file_bytes = 16ull << 30;
}  // namespace limits

struct DataSetOptions {
  /// Turns soot density into extinction; 8700 m2/kg at 633 nm for flaming fires (Mulholland and
  /// Croarkin 2000), smouldering must state its own. None: nobody has stated it.
  std::optional<double> mass_extinction_m2_per_kg = 8700;
  /// The field in a 3-D NRRD, unless the file says `field:=name`.
  std::string field = "extinction";
};

struct LoadedDataSet {
  DataSet data;                         // arrays that the file lacks are empty
  glm::dvec3 origin{0};                 // low corner of the box, in the file's coordinates [m]
  glm::dvec3 spacing{0};                // edges of a cell [m]
  std::vector<std::string> files_read;  // for a hash of the scene
  /// The file has soot, and no mass extinction was stated: what `data` has as extinction is its
  /// density.
  bool lacks_mass_extinction = false;
};

/// The file's ending decides the format. NRRD may hold several fields in one file: four dimensions,
/// the fields along the first, named by `fields:=a b c`; 8-bit samples are mapped to [old min, old
/// max] where stated. Errors, with the line where the file has lines: another format, more or fewer
/// values than declared, negative, infinite or undefined values (with their cell), albedo above 1,
/// extinction above limits::extinction_per_m, no known field, a rotated or mirrored grid, more than
/// the limits.
Result<LoadedDataSet> read_data_set(const std::string& path, const DataSetOptions& options = {});

}  // namespace luxodus
