// Writes imported smoke: its cells as NRRD (smoke.nrrd, overwritten by every import) and the table
// of a scene that names it (smoke.toml, the user's: made if missing). Any thread; one import at a
// time writes to a folder.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"
#include "scenes/formats/vdb/vdb.hpp"

namespace luxodus {

struct SmokeOrigin {
  std::string file;  // file that it came from, for comments
  std::string grid;
  double extinction_per_unit = 0;  // [1/m] for a value of 1
  double metres_per_unit = 1;      // unit of its lengths
};

/// Returns whether smoke.toml existed and was kept.
/// Errors: an extinction beyond limits::extinction_per_m, a file that cannot be written.
Result<bool> write_smoke(const VdbSmoke& smoke, const SmokeOrigin& origin, const std::string& out);

}  // namespace luxodus
