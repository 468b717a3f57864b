#include "actors/apps/view/live_scene.hpp"

#include <catch2/catch.hpp>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/room_texts.hpp"
#include "tests/kit/temporary_folder.hpp"

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
)" + test::exit_sign_at("[5.9, 2, 2.2]") +
                         R"(
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
  return *test::described(file);
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

TEST_CASE("edits move signs and luminaires and scale smoke", "[view]") {
  const test::TemporaryFolder folder;
  const SceneDescription scene = scene_of(folder.write("room.toml", room));
  SceneEdits edits;
  edits.signs["exit"] = {{0.1, 2, 2}, glm::dvec3(1, 0, 0)};
  edits.luminaires["lamp"] = {{1, 1, 2.5}, std::nullopt};
  const auto moved = live_description(scene, edits);
  REQUIRE(moved.ok());
  CHECK(moved->signs[0].frame.origin == glm::dvec3(0.1, 2, 2));
  CHECK(moved->signs[0].frame.axes[2].x == Approx(1));
  CHECK(moved->emitters[0].frame.origin == glm::dvec3(1, 1, 2.5));
  CHECK(moved->emitters[0].frame.axes == scene.emitters[0].frame.axes);
  edits.smoke = 3;
  const auto thick = compile_live(scene, edits);
  REQUIRE(thick.ok());
  CHECK(thick.value()->scenario.smoke_factor == 3);
  edits.signs["exit"].facing = glm::dvec3(0);
  CHECK_FALSE(live_description(scene, edits).ok());
}

TEST_CASE("a saved variant is the building as shown", "[view]") {
  const test::TemporaryFolder folder;
  const SceneDescription scene = scene_of(folder.write("room.toml", room));
  SceneEdits edits;
  edits.signs["exit"] = {{0.1, 2, 2}, glm::dvec3(1, 0, 0)};
  edits.smoke = 2;
  const std::string text =
      variant_text(scene, edits, {{"lamp", 0.5}, {group_of_sign("exit"), 2}}, "turned");
  const SceneDescription variant = scene_of(folder.write("turned.toml", text));
  CHECK(variant.signs[0].frame.origin == glm::dvec3(0.1, 2, 2));
  CHECK(variant.signs[0].frame.axes[2].x == Approx(1));
  CHECK(variant.signs[0].colours[0].mains_cd_m2 == 1000);
  CHECK(variant.emitters[0].mains_flux == 500);
  CHECK(variant.emitters[0].frame.origin == scene.emitters[0].frame.origin);
  REQUIRE(variant.scenarios.size() == 2);
  CHECK(variant.scenarios[0].media.front().factor == 2);
  CHECK(variant.scenarios[1].media.front().factor == 0);  // clear air stays clear
}

namespace {

SceneEdits added_to_room() {
  SceneEdits edits;
  edits.added = {{false, "lamp", "lamp copy"}, {true, "exit", "exit copy"}};
  edits.luminaires["lamp copy"] = {{1, 1, 2.9}, std::nullopt};
  edits.signs["exit copy"] = {{0.1, 2, 2}, glm::dvec3(1, 0, 0)};
  edits.signs["exit"] = {{5.9, 1, 2.2}, std::nullopt};
  return edits;
}

}  // namespace

TEST_CASE("an addition is a copy of the original in the file, at its own place", "[view]") {
  const test::TemporaryFolder folder;
  const SceneDescription scene = scene_of(folder.write("room.toml", room));
  const SceneEdits edits = added_to_room();
  const auto now = live_description(scene, edits);
  REQUIRE(now.ok());
  REQUIRE(now->signs.size() == 2);
  CHECK(now->signs[0].frame.origin == glm::dvec3(5.9, 1, 2.2));
  CHECK(now->signs[1].name == "exit copy");
  CHECK(now->signs[1].group == group_of_sign("exit copy"));
  CHECK(now->signs[1].frame.origin == glm::dvec3(0.1, 2, 2));
  CHECK(now->signs[1].colours[0].mains_cd_m2 == scene.signs[0].colours[0].mains_cd_m2);
  REQUIRE(now->emitters.size() == 2);
  CHECK(now->emitters[1].frame.origin == glm::dvec3(1, 1, 2.9));
  CHECK(now->emitters[1].frame.axes == scene.emitters[0].frame.axes);
  SceneEdits wrong = edits;
  wrong.added.push_back({true, "none", "none copy"});
  CHECK_FALSE(live_description(scene, wrong).ok());
}

TEST_CASE("a saved variant contains the additions, and compiles to the same building", "[view]") {
  const test::TemporaryFolder folder;
  const SceneDescription scene = scene_of(folder.write("room.toml", room));
  const SceneEdits edits = added_to_room();
  const std::string text = variant_text(
      scene, edits, {{"lamp", 0.5}, {"lamp copy", 0.25}, {group_of_sign("exit copy"), 2}}, "more");
  const SceneDescription variant = scene_of(folder.write("more.toml", text));
  REQUIRE(variant.signs.size() == 2);
  REQUIRE(variant.emitters.size() == 2);
  CHECK(variant.emitters[0].mains_flux == 500);
  CHECK(variant.emitters[1].mains_flux == 250);  // a copy of the file's own luminaire, not of the
                                                 // dimmed one
  CHECK(variant.signs[1].colours[0].mains_cd_m2 == 1000);
  const auto live = compile_live(scene, edits), fresh = compile_live(variant, {});
  REQUIRE(live.ok());
  REQUIRE(fresh.ok());
  const CompiledScene &a = *live.value(), &b = *fresh.value();
  CHECK(a.patch_count == b.patch_count);
  REQUIRE(a.surfaces.size() == b.surfaces.size());
  for (size_t s = 0; s < a.surfaces.size(); ++s) CHECK(a.surfaces[s].name == b.surfaces[s].name);
  REQUIRE(a.emitters.size() == b.emitters.size());
  for (size_t e = 0; e < a.emitters.size(); ++e) {
    CHECK(a.emitters[e].name == b.emitters[e].name);
    CHECK(a.emitters[e].origin == b.emitters[e].origin);
    CHECK(a.emitters[e].axes == b.emitters[e].axes);
  }
  REQUIRE(a.groups.size() == b.groups.size());
  for (size_t g = 0; g < a.groups.size(); ++g) CHECK(a.groups[g].name == b.groups[g].name);
}

TEST_CASE("bands stay those of the scene, whatever the copies' light", "[view]") {
  const test::TemporaryFolder folder;
  SceneDescription scene = scene_of(folder.write("room.toml", room));
  scene.emitters[0].spectrum =
      Spectrum::constant(1.0 / 400) * reflectance_from_linear_srgb(1, 0, 0);
  SceneEdits edits;
  edits.added = {{false, "lamp", "lamp copy"}};
  edits.luminaires["lamp copy"] = {{1, 1, 2.9}, std::nullopt};
  const auto before = compile_live(scene, {}), after = compile_live(scene, edits);
  REQUIRE(before.ok());
  REQUIRE(after.ok());
  const Bands &a = before.value()->bands, &b = after.value()->bands;
  REQUIRE(a.count() == b.count());
  for (int i = 0; i < a.count(); ++i) {
    CHECK(a[i].high_nm == b[i].high_nm);
    CHECK(a[i].lm_per_w == b[i].lm_per_w);
  }
}

TEST_CASE("copies are numbered, and no name is used twice", "[view]") {
  const test::TemporaryFolder folder;
  SceneDescription scene = scene_of(folder.write("room.toml", room));
  SceneEdits edits;
  const auto add = [&](const std::string& of) {
    const std::string name = name_for_copy(scene, edits, of, false);
    edits.added.push_back({true, "exit", name});
    return name;
  };
  CHECK(add("exit") == "exit copy");
  CHECK(add("exit") == "exit copy 2");
  CHECK(add("exit copy 2") == "exit copy 3");
  CHECK(add("lamp") == "lamp copy");
  scene.emitters[0].name = "sign door copy";  // its group has the name of a sign's
  CHECK(add("door") == "door copy 2");
  CHECK(add("copy") == "copy copy");
  CHECK(add("copy that") == "copy that copy");
  CHECK(name_for_copy(scene, edits, "downlight", true) == "downlight");
  edits.added.push_back({false, "downlight", "downlight", true});
  CHECK(name_for_copy(scene, edits, "downlight", true) == "downlight 2");
}

TEST_CASE("after a failure luminaires come on and phosphor fades, by shares of the traced light",
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
  // Traced as at the start, whatever time the scenario states.
  const auto compiled = compile_live(scene, {});
  REQUIRE(compiled.ok());
  CHECK(compiled.value()->groups[0].luminous_flux_lm == Approx(100));
  CHECK(compiled.value()->signs[0].colours[0].luminance_cd_m2 == Approx(0.8 * 100));
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
  // A run of the same scenario has the light at that time; without a stated time it has all light.
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

TEST_CASE("a building dimmed for a picture has one source group, and flames are dimmed, too",
          "[view]") {
  const test::TemporaryFolder folder;
  const auto scene = test::described(folder.write("scene.toml", room + R"(
[[medium]]
name = "fire"
kind = "bounded"
body = "cone"
position = [3, 2, 0.5]
radius = 0.3
height = 1
extinction = 1
albedo = 0
emission = { power_w = 1000, temperature_k = 1800 }
)"));
  SceneEdits edits;
  edits.scenario = "day";
  const auto lumens = [&](const std::map<std::string, double>& factors) {
    const auto compiled = compile_dimmed(*scene, edits, factors);
    REQUIRE(compiled.ok());
    CHECK(compiled.value()->groups.size() == 1);
    double lamps = 0, flames = 0;
    for (const CompiledEmitter& e : compiled.value()->emitters) {
      if (e.kind == EmitterKind::volume) flames += e.luminous_flux_lm;
      if (e.kind != EmitterKind::volume && e.sign == none_index) lamps += e.luminous_flux_lm;
    }
    return std::pair(lamps, flames);
  };
  const auto all = lumens({});
  const auto dimmed = lumens({{group_of_luminaire("lamp"), 0.5}, {group_of_flame("fire"), 0.25}});
  CHECK(all.first == Approx(1000).epsilon(1e-3));
  CHECK(dimmed.first == Approx(500).epsilon(1e-3));
  CHECK(dimmed.second == Approx(0.25 * all.second));
}
