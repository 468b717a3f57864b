// [[people]]: whose ways are followed, apart from the scene.
#include "scenes/formats/scene_file/scene_people.hpp"

#include <catch2/catch.hpp>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

std::string faults_of(const Problems& problems) {
  std::string out;
  for (const Problem& one : problems.list()) out += one.text() + "\n";
  return out;
}

}  // namespace

TEST_CASE("people have a file, a transform, floors and eyes", "[format][people]") {
  const TemporaryFolder folder;
  folder.write("ways.txt", "# framerate: 2\n");
  folder.write("base.toml",
               "[[people]]\nname = \"staff\"\nfile = \"ways.txt\"\nfloor_m = 3.2\n"
               "eye_height_m = 1.5\nluminance_before = 30\n");
  const auto scene = folder.write(
      "scene.toml",
      "include = [\"base.toml\"]\n[[people]]\nname = \"guests\"\nfile = \"ways.txt\"\n"
      "turn_deg = 90\nshift = [1, 2, 3]\ntime_shift_s = -30\n"
      "[[people.storey]]\nlow = [9, 0]\nhigh = [0, 5]\nfloor_m = 4\nshift = [-10, 0]\n");
  const ReadPeople read = read_people_of_scene(scene);
  INFO(faults_of(read.problems));
  REQUIRE(read.people.size() == 2);
  CHECK(read.people[0].name == "staff");
  CHECK(read.people[0].floor_m == 3.2);
  CHECK(read.people[0].eye_height_m == 1.5);
  CHECK(read.people[0].luminance_before_cd_m2 == 30.0);
  const PeopleSettings& guests = read.people[1];
  CHECK(guests.file == (folder / "ways.txt").string());
  CHECK(guests.turn_deg == 90);
  CHECK(guests.shift == glm::dvec3(1, 2, 3));
  CHECK(guests.time_shift_s == -30);
  CHECK_FALSE(guests.eye_height_m);
  REQUIRE(guests.storeys.size() == 1);
  CHECK(guests.storeys[0].low == glm::dvec2(0, 0));
  CHECK(guests.storeys[0].high == glm::dvec2(9, 5));
  CHECK(guests.storeys[0].floor_m == 4);
  CHECK(guests.storeys[0].shift == glm::dvec2(-10, 0));
}

TEST_CASE("mistakes in people are reported, and people change no scene", "[format][people]") {
  const TemporaryFolder folder;
  folder.write("ways.txt", "# framerate: 2\n");
  const auto fault = [&](const std::string& keys) {
    const ReadScene scene = read_scene(folder.write("scene.toml", "[[people]]\n" + keys));
    const ReadPeople people = read_people_of_scene(folder / "scene.toml");
    CHECK(faults_of(scene.problems) == faults_of(people.problems));
    CHECK((!scene.problems.empty() || people.people.size() == 1));
    return faults_of(scene.problems);
  };
  CHECK_THAT(fault("file = \"ways.txt\"\n"), Catch::Contains("'name'"));
  CHECK_THAT(fault("name = \"a\"\nfile = \"none.txt\"\n"), Catch::Contains("none.txt"));
  CHECK_THAT(fault("name = \"a\"\nfile = \"ways.txt\"\nfloor_m = 1\n[[people.storey]]\nlow = [0, "
                   "0]\nhigh = [1, 1]\nfloor_m = 0\n"),
             Catch::Contains("exclude each other"));
  CHECK_THAT(fault("name = \"a\"\nfile = \"ways.txt\"\n[[people]]\nname = \"a\"\nfile = "
                   "\"ways.txt\"\n"),
             Catch::Contains("'a'"));
  CHECK(fault("name = \"a\"\nfile = \"ways.txt\"\n").empty());
}
