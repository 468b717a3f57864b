// Smoke given as even cells, as files of a scene.
#include "actors/import/write_smoke.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "scenes/formats/fields/data_set.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

/// 3 x 2 x 1 cells of 0.5 x 0.25 x 0.125.
VdbSmoke six_cells() {
  return {3, 2, 1, {10, 20, 30}, {0.5, 0.25, 0.125}, {0, 1, 2, 3, 0.5F, 0}};
}

}  // namespace

TEST_CASE("written smoke is read back as a data set, in metres and 1/m", "[vdb][import]") {
  const TemporaryFolder folder;
  const VdbSmoke smoke = six_cells();
  const std::string out = (folder / "smoke").string();
  const SmokeOrigin origin{"smoke.vdb", "density", 2.0, 0.01};
  const auto first = write_smoke(smoke, origin, out);
  REQUIRE(first.ok());
  CHECK_FALSE(first.value());
  const auto back = read_data_set((folder / "smoke/smoke.nrrd").string());
  if (!back) FAIL(back.problem().text());
  CHECK(glm::length(back->origin - smoke.origin * 0.01) < 1e-9);
  CHECK(glm::length(back->spacing - smoke.spacing * 0.01) < 1e-9);
  REQUIRE(back->data.extinction.size() == smoke.values.size());
  for (size_t i = 0; i < smoke.values.size(); ++i)
    CHECK(back->data.extinction[i] == 2 * smoke.values[i]);
}

TEST_CASE("the next import keeps the user's text about imported smoke", "[vdb][import]") {
  const TemporaryFolder folder;
  const std::string out = (folder / "smoke").string();
  const SmokeOrigin origin{"smoke.vdb", "density", 2.0, 1};
  REQUIRE(write_smoke(six_cells(), origin, out).ok());
  std::ofstream(folder / "smoke/smoke.toml") << "# mine\n";
  const auto second = write_smoke(six_cells(), origin, out);
  REQUIRE(second.ok());
  CHECK(second.value());
  std::string line;
  std::ifstream kept(folder / "smoke/smoke.toml");
  REQUIRE(std::getline(kept, line));
  CHECK(line == "# mine");
}

TEST_CASE("a density beyond the limit is rejected", "[vdb][import]") {
  const TemporaryFolder folder;
  const auto dense =
      write_smoke(six_cells(), {"a.vdb", "density", 1e9, 1}, (folder / "smoke").string());
  REQUIRE_FALSE(dense.ok());
  CHECK_THAT(dense.problem().what, Contains("is no smoke"));
  CHECK(folder.entries() == 0);
}
