#include "actors/view/live_scene.hpp"

#include <catch2/catch.hpp>

#include "scenes/format/scene_file.hpp"
#include "tests/unit/scenes/format/temporary_folder.hpp"

using namespace luxodus;

namespace {

const std::string room = R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"

[[emitter]]
name = "lamp"
shape = "rectangle"
position = [3, 2, 2.9]
size = [0.5, 0.5]
flux_lm = 1000

[[sign]]
name = "exit"
position = [5.9, 2, 2.2]
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.15
mains_white = 500
mains_green = 50
emergency_white = 100
emergency_green = 10

[[medium]]
name = "haze"
kind = "homogeneous"
extinction = 0.2
albedo = 0.9

[[scenario]]
name = "day"

[[scenario]]
name = "clear"
media = { haze = 0 }
)";

SceneDescription scene_of(const std::string& file) {
  auto read = read_scene(file);
  for (const Problem& problem : read.problems.list()) UNSCOPED_INFO(problem.text());
  REQUIRE(read.scene);
  return std::move(*read.scene);
}

}  // namespace

TEST_CASE("each light of a live scene is a group of its own, whatever the file says", "[view]") {
  const test::TemporaryFolder folder;
  const SceneDescription scene = scene_of(folder.write("room.toml", room));
  const auto compiled = compile_live(scene, {});
  REQUIRE(compiled.ok());
  std::vector<std::string> names;
  for (const Group& group : compiled.value()->groups) names.push_back(group.name);
  CHECK(names == std::vector<std::string>{group_of_luminaire("lamp"), group_of_sign("exit")});
  CHECK_FALSE(compile_live(scene, {"night", 1, {}, {}}).ok());
}

TEST_CASE("a wish moves signs and luminaires and thickens smoke", "[view]") {
  const test::TemporaryFolder folder;
  const SceneDescription scene = scene_of(folder.write("room.toml", room));
  LiveWish wish;
  wish.signs["exit"] = {{0.1, 2, 2}, glm::dvec3(1, 0, 0)};
  wish.luminaires["lamp"] = {{1, 1, 2.5}, std::nullopt};
  const auto moved = live_description(scene, wish);
  REQUIRE(moved.ok());
  CHECK(moved->signs[0].frame.origin == glm::dvec3(0.1, 2, 2));
  CHECK(moved->signs[0].frame.axes[2].x == Approx(1));
  CHECK(moved->emitters[0].frame.origin == glm::dvec3(1, 1, 2.5));
  CHECK(moved->emitters[0].frame.axes == scene.emitters[0].frame.axes);
  wish.smoke = 3;
  const auto thick = compile_live(scene, wish);
  REQUIRE(thick.ok());
  CHECK(thick.value()->scenario.smoke_factor == 3);
  wish.signs["exit"].facing = glm::dvec3(0);
  CHECK_FALSE(live_description(scene, wish).ok());
}

TEST_CASE("a saved variant is the building as it was seen", "[view]") {
  const test::TemporaryFolder folder;
  const SceneDescription scene = scene_of(folder.write("room.toml", room));
  LiveWish wish;
  wish.signs["exit"] = {{0.1, 2, 2}, glm::dvec3(1, 0, 0)};
  wish.smoke = 2;
  const std::string text =
      variant_text(scene, wish, {{"lamp", 0.5}, {group_of_sign("exit"), 2}}, "turned");
  const SceneDescription variant = scene_of(folder.write("turned.toml", text));
  CHECK(variant.signs[0].frame.origin == glm::dvec3(0.1, 2, 2));
  CHECK(variant.signs[0].frame.axes[2].x == Approx(1));
  CHECK(variant.signs[0].mains.white_cd_m2 == 1000);
  CHECK(variant.emitters[0].mains_flux == 500);
  CHECK(variant.emitters[0].frame.origin == scene.emitters[0].frame.origin);
  REQUIRE(variant.scenarios.size() == 2);
  CHECK(variant.scenarios[0].media.front().factor == 2);
  CHECK(variant.scenarios[1].media.front().factor == 0);  // clear air stays clear
}

TEST_CASE("after a failure luminaires come on and phosphor fades, by shares of what is traced",
          "[view]") {
  const test::TemporaryFolder folder;
  SceneDescription scene = scene_of(folder.write("room.toml", room));
  scene.emitters[0].emergency_flux = 100;
  scene.signs[0].lighting = SignLighting::photoluminescent;
  scene.signs[0].decay = {{0, 0.8}, {60, 0.4}};
  scene.scenarios[0].operation = Operation::emergency;
  scene.emitters[0].onset = {{0, 0}, {5, 0.5}, {10, 1}};
  scene.scenarios[0].seconds_after_failure = 60;
  CHECK_FALSE(seconds_said(scene.scenarios[0]).has_value());
  scene.scenarios[0].says_seconds = true;
  CHECK(seconds_said(scene.scenarios[0]) == 60.0);
  CHECK_FALSE(seconds_said(scene.scenarios[1]).has_value());
  // Traced as at first, whatever time the scenario says.
  const auto compiled = compile_live(scene, {});
  REQUIRE(compiled.ok());
  CHECK(compiled.value()->groups[0].luminous_flux_lm == Approx(100));
  CHECK(compiled.value()->signs[0].white_cd_m2 == Approx(0.8 * 100));
  const auto after = [&](double seconds) {
    return shares_after(scene, Operation::emergency, seconds);
  };
  CHECK(after(0).at("sign exit") == 1);
  CHECK(after(60).at("sign exit") == Approx(0.5));
  CHECK(after(0).at("lamp") == 0);
  CHECK(after(5).at("lamp") == 0.5);
  CHECK(after(60).at("lamp") == 1);
  CHECK(shares_after(scene, Operation::mains, 5.0).empty());
  CHECK(shares_after(scene, Operation::emergency, std::nullopt).empty());
  // A run of the same scenario has the light of that time; one that says no time has all of it.
  const auto lumens = [&](Scenario scenario, bool says) {
    scenario.seconds_after_failure = 5;
    scenario.says_seconds = says;
    const auto run = compile_scene(std::make_shared<SceneDescription>(scene), scenario, {});
    REQUIRE(run.ok());
    return run.value()->emitters.front().luminous_flux_lm;
  };
  CHECK(lumens(scene.scenarios[0], true) == Approx(50));
  CHECK(lumens(scene.scenarios[0], false) == Approx(100));
}
