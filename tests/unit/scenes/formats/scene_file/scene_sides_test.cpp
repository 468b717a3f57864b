// The key open_sides: sides of the scene through which light is meant to leave.
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {

TEST_CASE("open sides are read by name, each once, in the order they are listed",
          "[format][scene]") {
  SceneFolder folder;
  const auto read = folder.read("open_sides = [\"top\", \"west\", \"top\"]\n");
  INFO(all_problems(read));
  REQUIRE(read.scene);
  CHECK(read.scene->open_sides == std::vector<Side>{Side::top, Side::west});
  CHECK(folder.read("title = \"closed\"\n").scene->open_sides.empty());
}

TEST_CASE("an unknown side is rejected with a list of the known ones", "[format][scene]") {
  SceneFolder folder;
  const auto read = folder.read("title = \"x\"\nopen_sides = [\"roof\"]\n");
  CHECK_FALSE(read.scene);
  const std::string said = all_problems(read);
  CHECK(said.find("scene.toml:2: 'open_sides' knows no side 'roof'") != std::string::npos);
  CHECK(said.find("west, east, south, north, bottom or top") != std::string::npos);
}

TEST_CASE("a file's own open sides replace those of the files that it includes",
          "[format][scene]") {
  SceneFolder folder;
  folder.put("part.toml", "open_sides = [\"east\"]\n");
  const auto own = folder.read("include = [\"part.toml\"]\nopen_sides = [\"top\"]\n");
  REQUIRE(own.scene);
  CHECK(own.scene->open_sides == std::vector<Side>{Side::top});
  const auto theirs = folder.read("include = [\"part.toml\"]\n");
  REQUIRE(theirs.scene);
  CHECK(theirs.scene->open_sides == std::vector<Side>{Side::east});
}

}  // namespace luxodus
