// Profiles of a real scene: their counts, and their file.
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>

#include "actors/cast/parts/profile_file.hpp"
#include "actors/results/run/batch_plan.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
namespace fs = std::filesystem;

namespace {

std::shared_ptr<const CompiledScene> tank(int cells) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/smoke_tank.toml");
  REQUIRE(read.scene);
  const auto description = std::make_shared<const SceneDescription>(std::move(*read.scene));
  auto scene = compile_scene(description, find_scenario(*description, "").value(), {cells});
  REQUIRE(scene.ok());
  return scene.value();
}

ReferenceProfile profile_of(const CompiledScene& scene, uint64_t budget_bytes) {
  const SceneObjects objects(scene, std::array{NodeId{0}}, 1);
  const EmbreeDevice device;
  const ProxyScene proxies(device, scene.cell_boxes);
  auto profile = count_references(scene, objects, proxies, 1,
                                  profile_particles(BatchPlan(scene).shares(), 2000), budget_bytes);
  REQUIRE(profile.ok());
  return profile.value();
}

constexpr uint64_t plenty = std::numeric_limits<uint64_t>::max();

}  // namespace

TEST_CASE(
    "a profile's counts do not depend on its budget, and no cell is visited more often than "
    "possible",
    "[profile]") {
  const auto scene = tank(24);
  const ReferenceProfile profile = profile_of(*scene, plenty);
  CHECK(profile == profile_of(*scene, 1));
  REQUIRE(profile.groups.size() == scene->groups.size());
  uint64_t references = 0;
  for (const ReferenceCounts& counts : profile.groups) {
    CHECK(counts.units >= 256);
    for (size_t cell = 0; cell < profile.objects(); ++cell) {
      CHECK(counts.visits[cell] <= counts.references[cell]);
      CHECK(counts.visits[cell] <= static_cast<uint64_t>(counts.units));
      CHECK((counts.visits[cell] == 0) == (counts.references[cell] == 0));
      references += counts.references[cell];
      if (counts.references[cell] > 0) CHECK(profile.built_bytes[cell] > 0);
    }
  }
  CHECK(references > 2000);  // every particle hits something
}

TEST_CASE("a profile has particles of every group, and no more than its limit", "[profile]") {
  const auto few = profile_particles({0.999, 0.001}, 10'000);
  CHECK(few == std::vector<int64_t>{9990, 256});
  const auto many = profile_particles({0.5, 0.5}, int64_t{1} << 50);
  CHECK(many == std::vector<int64_t>(2, limits::profile_particles / 2));
}

TEST_CASE("a profile is read back from its file, and rejected for another partition", "[profile]") {
  const auto scene = tank(24);
  const ReferenceProfile profile = profile_of(*scene, plenty);
  const size_t objects = scene->cell_boxes.size();  // no smoke data, no pictures
  const test::TemporaryFolder folder;
  const fs::path file = folder / "profile";
  REQUIRE(write_profile(file, profile).ok());
  const auto back = read_profile(file, *scene, objects);
  REQUIRE(back.ok());
  CHECK(back.value() == profile);
  const auto other = read_profile(file, *tank(12), 12);
  REQUIRE_FALSE(other.ok());
  CHECK(other.problem().what.find("another scene") != std::string::npos);
  fs::resize_file(file, fs::file_size(file) / 2);
  CHECK_FALSE(read_profile(file, *scene, objects).ok());
  std::ofstream(file) << "no profile";
  CHECK_FALSE(read_profile(file, *scene, objects).ok());
}
