// Smoke of OpenVDB files in a user's steps: listed, imported, checked, run; and messages and files
// if the reading program fails.
#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;
using Catch::Contains;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool memory_is_limited = false;  // isolated_job.hpp
#else
constexpr bool memory_is_limited = true;
#endif

const std::string vdb_import_options = " --extinction-per-unit 2";

std::string vdb_import_command(const fs::path& file, const fs::path& out) {
  return "import vdb " + file.string() + " --out " + out.string() + vdb_import_options;
}

/// A scene of the imported smoke, and a lamp.
std::string lamp_at(const std::string& position) {
  return "include = [\"smoke/smoke.toml\"]\n[[emitter]]\nname = \"lamp\"\nshape = \"point\"\n"
         "distribution = \"isotropic\"\nflux_lm = 1000\nposition = [" +
         position + "]\n";
}

/// luxodus in a folder of its own beside another luxodus_vdb.
std::string luxodus_beside(const TemporaryFolder& folder, const fs::path& vdb_program) {
  fs::create_directories(folder / "bin");
  std::error_code elsewhere;
  fs::create_hard_link(LUX_PROGRAM, folder / "bin/luxodus", elsewhere);
  if (elsewhere) fs::copy_file(LUX_PROGRAM, folder / "bin/luxodus");
  fs::create_symlink(vdb_program, folder / "bin/luxodus_vdb");
  return (folder / "bin/luxodus").string() + " ";
}

}  // namespace

TEST_CASE("a file that is not OpenVDB is rejected by name", "[program][import][vdb]") {
  const TemporaryFolder folder;
  folder.write("smoke.vdb", "no grids");
  const Outcome refused = run_luxodus(folder, "import vdb " + (folder / "smoke.vdb").string());
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("smoke.vdb: "));
  CHECK_FALSE(fs::exists(folder / "smoke"));
}

#ifdef LUX_SMALL_VDB

TEST_CASE("an OpenVDB file is listed, and becomes smoke in which light is traced",
          "[program][import][vdb]") {
  const TemporaryFolder folder;
  REQUIRE(shell(folder, std::string(LUX_SMALL_VDB) + " " + (folder / "small.vdb").string()).code ==
          0);
  const Outcome listed = run_luxodus(folder, "import vdb " + (folder / "small.vdb").string());
  INFO(listed.err);
  REQUIRE(listed.code == 0);
  CHECK_THAT(listed.out, Contains("grid \"density\": float, fog volume, 3 cells\n"));
  CHECK_THAT(listed.out, Contains("\"surface\"") && Contains("not read: it is a level set"));
  CHECK(folder.entries() == 3);  // the file, and the output

  const Outcome made =
      run_luxodus(folder, vdb_import_command(folder / "small.vdb", folder / "smoke"));
  INFO(made.err);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.out, Contains("cells 3 x 3 x 3, 1.5 x 0.75 x 0.375 m\n"));
  const auto scene = folder.write("scene.toml", lamp_at("11.5, 20, 32"));
  const Outcome run = run_luxodus(
      folder, "run " + scene.string() + " --particles 20k --out " + (folder / "out").string());
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.out, Contains("escaped") && !Contains("100 % escaped"));
}

TEST_CASE("an OpenVDB file of another program is imported", "[program][import][vdb]") {
  const fs::path file = fs::path(LUX_SHARED_DATA) / "vdb/smoke_layer_own.vdb";
  if (!fs::is_regular_file(file)) {
    WARN("skipped: the file is not there (" << file.string() << ")");
    return;
  }
  const TemporaryFolder folder;
  const Outcome made = run_luxodus(folder, vdb_import_command(file, folder / "smoke"));
  INFO(made.err);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.out, Contains("cells 64 x 42 x 9, 12 x 7.875 x 1.688 m"));
  const auto scene = folder.write("scene.toml", lamp_at("6, 4, 3"));
  const Outcome checked = run_luxodus(folder, "check " + scene.string());
  INFO(checked.err);
  CHECK(checked.code == 0);
  CHECK_THAT(checked.out, Contains("no errors"));
}

#else

TEST_CASE("an OpenVDB file is listed, and becomes smoke in which light is traced",
          "[program][import][vdb]") {
  WARN("skipped: OpenVDB is not there, which makes the file (./setup.sh)");
}

#endif

TEST_CASE("a failing reader of OpenVDB files is one error, and an earlier import is unchanged",
          "[program][import][vdb]") {
  const TemporaryFolder folder;
  const std::string luxodus = luxodus_beside(folder, LUX_ODD_VDB);
  fs::create_directories(folder / "smoke");
  folder.write("smoke/smoke.nrrd", "of before");
  const auto [fault, said] = GENERATE(table<std::string, std::string>({
      {"crash", "reading it ended in a crash (Segmentation fault)"},
      {"loop", "reading it takes longer than"},
      {"flood", "reading it takes more than 3072 MiB of memory"},
      {"throw", "reading it failed without a reason"},
      {"lie", "gave no sound answer"},
  }));
  if (fault == "flood" && !memory_is_limited) return;
  const auto file = folder.write("odd.vdb", fault + "\n");
  const Outcome refused =
      shell(folder, luxodus + vdb_import_command(file, folder / "smoke") + " --seconds 1");
  INFO(fault << ": " << refused.err);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("odd.vdb: ") && Contains(said));
  CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 1);
  CHECK(slurp(folder / "smoke/smoke.nrrd") == "of before");
  CHECK(std::distance(fs::directory_iterator(folder / "smoke"), {}) == 1);
}

TEST_CASE("a luxodus_vdb of another build is one error that says what to do",
          "[program][import][vdb]") {
  const TemporaryFolder folder;
  // It serves jobs, but none with this build's name.
  const std::string luxodus = luxodus_beside(folder, LUX_ODD_NODE);
  const auto file = folder.write("small.vdb", "grids");
  const Outcome refused = shell(folder, luxodus + vdb_import_command(file, folder / "smoke"));
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("luxodus_vdb: luxodus_vdb is of another build") &&
                              Contains("cmake --build build/release --target luxodus luxodus_vdb"));
  CHECK_FALSE(fs::exists(folder / "smoke"));
}
