// This side believes nothing of the answer: sizes, places and values are checked again.
#include "scenes/vdb/vdb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/core/isolated_job.hpp"
#include "scenes/vdb/vdb_answer.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// The largest box of cells twice, where y is up, and on its way here; the tree of a grid, which
/// Blosc may have packed to a quarter; the library itself.
IsolatedLimits vdb_limits(uint64_t bytes) {
  return {(uint64_t{3} << 30) + 4 * bytes, 30 + static_cast<uint32_t>(bytes >> 22)};
}

/// The answer behind its mark of success.
Result<PlainReader> asked(const vdb::Question& question, const fs::path& program) {
  std::error_code failed;
  if (!fs::is_regular_file(program, failed))
    return problem_in(
        question.file,
        "OpenVDB files are read by the program luxodus_vdb, which is not there: it is "
        "built where OpenVDB is installed (apt-get install libopenvdb-dev, and build "
        "again); or save the grid as VTI or NRRD");
  const uint64_t bytes = fs::file_size(question.file, failed);
  if (failed || !fs::is_regular_file(question.file, failed))
    return problem_in(question.file, "there is no such file");
  if (bytes > limits::vdb_bytes)
    return problem_in(question.file,
                      fmt::format("it has {} bytes, the most are {}: save the grid of the smoke "
                                  "alone",
                                  bytes, limits::vdb_bytes));
  auto in = ask_program(
      program.string(), vdb::job, [&](PlainWriter& out) { put(out, question); }, vdb_limits(bytes),
      "libopenvdb10.0");
  if (!in) return problem_in(question.file, in.problem().what);
  uint8_t good = 0;
  std::string why;
  if (!in->get(good) || (good != 1 && !in->get(why)))
    return problem_in(question.file, "cannot be read: luxodus_vdb gave no sound answer");
  if (good != 1) return problem_in(question.file, std::move(why));
  return in;
}

}  // namespace

Result<std::vector<VdbGrid>> list_vdb(const fs::path& file, const fs::path& program) {
  auto in = asked({file.string(), "", UpAxis::z}, program);
  if (!in) return in.problem();
  const Problem damaged =
      problem_in(file.string(), "cannot be read: luxodus_vdb gave no sound answer");
  uint64_t count = 0;
  if (!in->get(count) || count > limits::vdb_grids) return damaged;
  std::vector<VdbGrid> grids(count);
  for (VdbGrid& grid : grids)
    if (!vdb::get(in.value(), grid)) return damaged;
  return grids;
}

Result<VdbSmoke> read_vdb(const fs::path& file, const std::string& grid, UpAxis up,
                          const fs::path& program) {
  auto in = asked({file.string(), grid, up}, program);
  if (!in) return in.problem();
  VdbSmoke smoke;
  const bool sound = vdb::get(in.value(), smoke) &&
                     std::all_of(smoke.values.begin(), smoke.values.end(),
                                 [](float v) { return v >= 0 && std::isfinite(v); });
  for (const double edge : {smoke.spacing.x, smoke.spacing.y, smoke.spacing.z})
    if (!sound || !(edge > 0))
      return problem_in(file.string(), "cannot be read: luxodus_vdb gave no sound answer");
  return smoke;
}

}  // namespace luxodus
