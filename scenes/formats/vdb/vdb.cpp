// This side does not trust the answer: sizes, places and values are checked again.
#include "scenes/formats/vdb/vdb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/vdb/vdb_answer.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

constexpr char remedy[] =
    "build both (cmake --build build/release --target luxodus luxodus_vdb), or install both (cmake "
    "--install build/release, and again with --component vdb)";

/// The largest box of cells twice, for y up, and for the answer; the tree of a grid, which Blosc
/// may have packed to a quarter; the library itself.
IsolatedLimits vdb_limits(uint64_t bytes, const VdbProgram& program) {
  return {program.memory_bytes.value_or((uint64_t{3} << 30) + 4 * bytes),
          program.processor_s.value_or(30 + static_cast<uint32_t>(bytes >> 22))};
}

Problem unsound(const fs::path& file) {
  return problem_in(file, "cannot be read: luxodus_vdb gave no sound answer");
}

/// The size of the file [bytes]. Errors: no such file, or too large.
Result<uint64_t> checked_size(const fs::path& file) {
  const auto bytes = size_of_regular_file(file);
  if (bytes && bytes.value() > limits::vdb_bytes)
    return problem_in(file, fmt::format("it has {} bytes, the most are {}: save the grid of the "
                                        "smoke alone",
                                        bytes.value(), limits::vdb_bytes));
  return bytes;
}

/// The answer after its success flag.
Result<PlainReader> asked(const vdb::Question& question, const VdbProgram& program) {
  std::error_code failed;
  if (!fs::is_regular_file(program.path, failed))
    return problem_in(
        question.file,
        "OpenVDB files are read by the program luxodus_vdb, which is not there: it is "
        "built where OpenVDB is installed (apt-get install libopenvdb-dev, and build "
        "again); or save the grid as VTI or NRRD");
  const auto bytes = checked_size(question.file);
  if (!bytes) return bytes.problem();
  auto in = ask_program(
      {program.path.string(), "libopenvdb10.0", remedy}, vdb::job,
      [&](PlainWriter& out) { put(out, question); }, vdb_limits(bytes.value(), program),
      program.told);
  if (!in && !in.problem().where.file.empty()) return in.problem();  // of the program
  if (!in) return problem_in(question.file, in.problem());
  uint8_t good = 0;
  std::string why;
  if (!in->get(good) || (good != 1 && !in->get(why))) return unsound(question.file);
  if (good != 1) return problem_in(question.file, std::move(why));
  return in;
}

}  // namespace

Result<std::vector<VdbGrid>> list_vdb(const fs::path& file, const VdbProgram& program) {
  auto in = asked({file.string(), "", UpAxis::z}, program);
  if (!in) return in.problem();
  uint64_t count = 0;
  if (!in->get(count) || count > limits::vdb_grids) return unsound(file);
  std::vector<VdbGrid> grids(count);
  for (VdbGrid& grid : grids)
    if (!vdb::get(in.value(), grid)) return unsound(file);
  return grids;
}

Result<VdbSmoke> read_vdb(const fs::path& file, const std::string& grid, UpAxis up,
                          const VdbProgram& program) {
  auto in = asked({file.string(), grid, up}, program);
  if (!in) return in.problem();
  VdbSmoke smoke;
  if (!vdb::get(in.value(), smoke)) return unsound(file);
  const bool has_edges = smoke.spacing.x > 0 && smoke.spacing.y > 0 && smoke.spacing.z > 0;
  const bool is_smoke = std::all_of(smoke.values.begin(), smoke.values.end(),
                                    [](float v) { return v >= 0 && std::isfinite(v); });
  if (!has_edges || !is_smoke) return unsound(file);
  return smoke;
}

}  // namespace luxodus
