// A live view after the files of its scene have changed.
#include <catch2/catch.hpp>
#include <filesystem>

#include "actors/results/run/open_scene.hpp"
#include "scenes/light/world/files_as_read.hpp"
#include "tests/kit/small_fire.hpp"
#include "tests/unit/actors/apps/view/hub_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

const std::string watched_room = live_room +
                                 "[[observer]]\nname = \"walker\"\neye = [1, 2, 1.6]\n"
                                 "target = [5.9, 2, 2.2]\n"
                                 "[assessment]\nirritant_smoke = false\n";

/// The refusal that the viewer gets for this message.
std::string refused_when(Edited& live, const std::string& said) {
  live.says(said);
  live.posts.until([&] { return live.viewer.last("refused") != nullptr; });
  return live.why();
}

}  // namespace

TEST_CASE("verdicts, pictures, suggestions and variants of an edited scene are refused",
          "[view][changed]") {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", watched_room);
  Edited live(described(file));
  CHECK(live.verdicts_on("exit")["rows"].size() == 1);
  folder.write("scene.toml", watched_room);  // the same bytes: the scene is unchanged
  CHECK(live.verdicts_on("exit")["rows"].size() == 1);

  folder.write("scene.toml", watched_room + "# a word\n");
  const std::string why =
      file.string() + ": the scene has changed on disk since it was opened: open it again";
  CHECK(refused_when(live, R"({"type":"judge","sign":"exit"})") == why);
  CHECK(refused_when(live, R"({"type":"suggest","free":[]})") == why);
  CHECK((*live.viewer.last("refused"))["suggestion"] == true);
  CHECK(refused_when(live, R"({"type":"save","name":"mine"})") == why);
  CHECK_FALSE(std::filesystem::exists(live.folder / "mine.toml"));
  CHECK(refused_when(live, R"({"type":"render","id":4,"eye":[1,2,1.6],"target":[5,2,1.6],)"
                           R"("up":[0,0,1],"fov":55,"width":32,"height":24,"human":false})") ==
        "no picture: " + why);
  std::filesystem::remove(file);
  CHECK(refused_when(live, R"({"type":"judge","sign":"exit"})") == why);
}

TEST_CASE("a state at another time is refused if files were edited", "[view][changed]") {
  const TemporaryFolder folder;
  const std::string sinking = "[time]\nfrom = 0\nto = 60\nstep = 30\n" + watched_room +
                              "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nalbedo = 0.5\n"
                              "extinction = [[0, 0], [60, 1]]\n";
  const auto file = folder.write("scene.toml", sinking);
  const auto scene = described(file);
  const SceneAtTime at = reader_at_times(*scene, file, FireFrames::between);
  CHECK(at(30).ok());
  folder.write("scene.toml", sinking + "# a word\n");
  REQUIRE_FALSE(at(60).ok());
  CHECK_THAT(at(60).problem().text(), Contains("scene.toml: the scene has changed on disk"));
  folder.write("scene.toml", "no scene");
  REQUIRE_FALSE(at(60).ok());
  CHECK_THAT(at(60).problem().what, Contains("the scene has changed on disk"));
}

TEST_CASE(
    "verdicts at frames are refused for an edited scene, but not for a simulation in progress",
    "[view][changed][fds]") {
  const TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {6, 4, 3});
  const std::string label = "SOOT EXTINCTION COEFFICIENT";
  const auto thin = cell_values(mesh, [](int, int, int) { return 0.1F; });
  folder.write("a.sf", slice_file(mesh, label, {{0, thin}}));
  const std::string index = index_of_meshes({mesh}) + slice_entry(1, true, mesh, "a.sf", label);
  folder.write("fire.smv", index);
  const std::string text = watched_room +
                           "[[medium]]\nname = \"fire\"\nkind = \"fds\"\nfile = \"fire.smv\"\n"
                           "at_s = 0\nalbedo = 0.2\ng = 0.6\nangstrom = 1\n";
  const auto file = folder.write("scene.toml", text);
  const auto scene = described(file);
  const auto before = FrameScenes::of(*scene, file, std::nullopt);
  folder.write("a.sf", slice_file(mesh, label, {{0, thin}, {10, thin}}));
  // FDS appends events to its index, too.
  folder.write("fire.smv", index + "DEVICE_ACT\n     1    0.50000E+01     1\n");
  CHECK(scene->files->unchanged_on_disk());
  CHECK(before->at(std::nullopt).ok());
  const auto after = FrameScenes::of(*scene, file, std::nullopt);
  folder.write("scene.toml", text + "# a word\n");
  REQUIRE_FALSE(after->at(std::nullopt).ok());
  CHECK_THAT(after->at(std::nullopt).problem().what, Contains("the scene has changed on disk"));
}
