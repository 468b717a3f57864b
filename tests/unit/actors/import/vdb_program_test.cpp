// What is said where luxodus_vdb is not there, or cannot be begun. Needs no OpenVDB.
#include <catch2/catch.hpp>
#include <filesystem>

#include "scenes/vdb/vdb.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

std::string said_with_program(const TemporaryFolder& folder, const std::filesystem::path& program) {
  const auto grids = list_vdb(folder.write("smoke.vdb", "grids"), program);
  REQUIRE_FALSE(grids.ok());
  return grids.problem().what;
}

}  // namespace

TEST_CASE("a missing luxodus_vdb and missing libraries are no fault of the file", "[import][vdb]") {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  CHECK_THAT(said_with_program(folder, folder / "absent"),
             Contains("by the program luxodus_vdb, which is not there"));
  // As the loader of libraries ends a program.
  const fs::path program = folder.write("luxodus_vdb", "#!/bin/sh\nexit 127\n");
  fs::permissions(program, fs::perms::owner_all);
  CHECK(said_with_program(folder, program) ==
        "luxodus_vdb cannot be begun: its libraries are missing (apt-get install libopenvdb10.0)");
}
