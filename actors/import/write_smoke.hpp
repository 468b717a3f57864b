// The folder of imported smoke: its cells as NRRD (smoke.nrrd, written anew by every import) and
// the table of a scene that names it (smoke.toml, a person's: made where it is not there). One
// import at a time writes to a folder.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"
#include "scenes/formats/vdb/vdb.hpp"

namespace luxodus {

struct SmokeOrigin {
  std::string file;  // where it came from, for people
  std::string grid;
  double extinction_per_unit = 0;  // [1/m] of a value of 1
  double metres_per_unit = 1;      // of its lengths
};

/// Whether smoke.toml was there and is kept.
/// Errors: an extinction beyond limits::extinction_per_m, a file that cannot be written.
Result<bool> write_smoke(const VdbSmoke& smoke, const SmokeOrigin& origin, const std::string& out);

}  // namespace luxodus
