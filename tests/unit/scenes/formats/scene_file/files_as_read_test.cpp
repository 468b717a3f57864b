// The files that a scene was read from, and detection of changes.
#include "scenes/light/world/files_as_read.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {

namespace {

const std::string scene_of_files =
    "include = [\"more.toml\"]\n[[luminaire]]\nname = \"l\"\nfile = \"lamp.ies\"\n"
    "position = [0, 0, 2]\n[[import]]\nname = \"i\"\nfile = \"cube.obj\"\nunits = \"m\"\n"
    "up = \"z\"\nmaterial = \"grey50\"\n";

}  // namespace

TEST_CASE("a scene detects which of its files has changed on disk, whatever its kind",
          "[format][scene]") {
  for (const std::string changed :
       {"scene.toml", "more.toml", "lamp.ies", "cube.obj", "cube.mtl"}) {
    SceneFolder f;
    f.put("more.toml", "title = \"more\"\n");
    const auto files = good(f, scene_of_files).files;
    REQUIRE(files);
    CHECK(files->unchanged_on_disk());
    CHECK(files->unchanged_in(*good(f, scene_of_files).files));
    const auto hash = hash_of_file((f.path() / changed).string());
    REQUIRE(hash.ok());
    CHECK(files->hash_of((f.path() / changed).string()) == hash.value());
    f.put(changed, "another text\n");
    const auto unchanged = files->unchanged_on_disk();
    REQUIRE_FALSE(unchanged);
    CHECK(unchanged.problem().where.file == (f.path() / changed).string());
    CHECK(unchanged.problem().what ==
          "the scene has changed on disk since it was opened: open it again");
    std::filesystem::remove(f.path() / changed);
    const auto there = files->unchanged_on_disk();
    REQUIRE_FALSE(there);
    CHECK(there.problem().where.file == (f.path() / changed).string());
  }
}

TEST_CASE("two readings of a scene differ in the file that was changed between them",
          "[format][scene]") {
  SceneFolder f;
  f.put("more.toml", "title = \"more\"\n");
  const auto before = good(f, scene_of_files).files;
  f.put("more.toml", "title = \"other\"\n");
  const auto after = good(f, scene_of_files).files;
  const auto unchanged = before->unchanged_in(*after);
  REQUIRE_FALSE(unchanged);
  CHECK(unchanged.problem().where.file == (f.path() / "more.toml").string());
}

}  // namespace luxodus
