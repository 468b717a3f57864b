// Messages if luxodus_vdb is missing, or cannot be started. Needs no OpenVDB.
#include <catch2/catch.hpp>
#include <filesystem>

#include "scenes/formats/vdb/vdb.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

Problem said_with_program(const TemporaryFolder& folder, const std::filesystem::path& program) {
  const auto grids = list_vdb(folder.write("smoke.vdb", "grids"), {program});
  REQUIRE_FALSE(grids.ok());
  return grids.problem();
}

}  // namespace

TEST_CASE("a missing luxodus_vdb, or missing libraries, are not reported as faults of the file",
          "[import][vdb]") {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  CHECK_THAT(said_with_program(folder, folder / "absent").what,
             Contains("by the program luxodus_vdb, which is not there"));
  // As the dynamic loader ends a program with missing libraries.
  const fs::path program = folder.write("luxodus_vdb", "#!/bin/sh\nexit 127\n");
  fs::permissions(program, fs::perms::owner_all);
  const Problem missing = said_with_program(folder, program);
  CHECK(missing.where.file == program.string());
  CHECK(missing.what ==
        "luxodus_vdb cannot be begun: its libraries are missing (apt-get install libopenvdb10.0)");
}

TEST_CASE("a luxodus_vdb of another build is reported by name, with a remedy", "[import][vdb]") {
  const TemporaryFolder folder;
  // This test program serves jobs, but none with this name: like a luxodus_vdb of other sources.
  const std::filesystem::path program = folder / "luxodus_vdb";
  std::filesystem::create_symlink(std::filesystem::read_symlink("/proc/self/exe"), program);
  const Problem stale = said_with_program(folder, program);
  CHECK(stale.where.file == program.string());
  CHECK_THAT(stale.what,
             Contains("luxodus_vdb is of another build than this program: build both "));
}

TEST_CASE("a luxodus_vdb that is another program is reported by name", "[import][vdb]") {
  const TemporaryFolder folder;
  const Problem silent = said_with_program(folder, "/bin/true");
  CHECK(silent.where.file == "/bin/true");
  CHECK_THAT(silent.what, Contains("gives no answer: build both "));
}
