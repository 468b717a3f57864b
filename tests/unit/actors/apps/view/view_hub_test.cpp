// The hub with viewers that record messages.
#include "actors/apps/view/view_hub.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>
#include <set>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/small_fire.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/apps/view/hub_kit.hpp"

using namespace luxodus;
using test::Edited;
using test::Posts;
using test::Remembers;
using test::scene_in;
using test::small_runs;

TEST_CASE("viewers get the building and its light, and edits of one reach all", "[view]") {
  const test::TemporaryFolder folder;
  Posts posts;
  ViewHub hub(scene_in(folder), small_runs(folder), posts.post());
  Remembers first, second;
  hub.joins(first);
  posts.until([&] { return first.frames_of(2, 1) >= 2; });
  REQUIRE(first.last("scene") != nullptr);
  CHECK((*first.last("scene"))["editor"] == true);
  CHECK((*first.last("scene"))["groups"].size() == 2);
  CHECK(first.frames_of(1, 1) == 1);
  hub.joins(second);  // late: it gets the present state
  CHECK((*second.last("scene"))["editor"] == false);
  CHECK(second.frames_of(1, 1) == 1);
  CHECK(second.frames_of(2, 1) == 2);
  const std::string dim = R"({"type":"factor","group":"left","factor":0.5})";
  hub.says(second, dim);
  CHECK((*second.last("refused"))["why"].get<std::string>().find("somebody else") == 0);
  hub.says(first, dim);
  CHECK((*second.last("factors"))["factors"]["left"] == 0.5);
  hub.says(second, R"({"type":"edit","wanted":true})");
  CHECK((*second.last("editor"))["editor"] == true);
  CHECK((*first.last("editor"))["editor"] == false);
  hub.leaves(second);
  CHECK(hub.viewers() == 1);
  hub.leaves(first);
}

TEST_CASE("a move begins a new generation, and questions about light are answered", "[view]") {
  const test::TemporaryFolder folder;
  Posts posts;
  ViewHub hub(scene_in(folder), small_runs(folder), posts.post());
  Remembers viewer;
  hub.joins(viewer);
  posts.until([&] {
    const Json* progress = viewer.last("progress");
    return progress != nullptr && (*progress)["done"] == true;
  });
  hub.says(viewer, R"({"type":"probe","id":5,"triangle":0,"front":true})");
  posts.until([&] { return viewer.last("probe") != nullptr; });
  const Json full = *viewer.last("probe");
  CHECK(full["id"] == 5);
  CHECK(full["illuminance"].get<double>() > 10);
  // Lambertian grey of a half: luminance = 0.5 E / pi.
  CHECK(full["luminance"].get<double>() ==
        Approx(0.5 * full["illuminance"].get<double>() / std::numbers::pi).epsilon(1e-6));
  for (const char* group : {"left", "right"})
    hub.says(viewer, std::string(R"({"type":"factor","factor":0.5,"group":")") + group + "\"}");
  viewer.texts.clear();
  hub.says(viewer, R"({"type":"probe","id":6,"triangle":0,"front":true})");
  posts.until([&] { return viewer.last("probe") != nullptr; });
  CHECK((*viewer.last("probe"))["illuminance"].get<double>() ==
        Approx(0.5 * full["illuminance"].get<double>()));
  hub.says(viewer, R"({"type":"move","kind":"luminaire","name":"left","position":[1,1,1]})");
  posts.until([&] { return viewer.frames_of(2, 2) >= 2; });
  const Json& scene = *viewer.last("scene");
  CHECK(scene["generation"] == 2);
  CHECK(scene["groups"][0]["light"] == "new");
  CHECK(scene["groups"][1]["light"] == "kept");
  CHECK(viewer.frames_of(1, 2) == 0);  // unchanged geometry is not sent again
  hub.says(viewer, R"({"type":"move","kind":"sign","name":"none","position":[1,1,1]})");
  CHECK(viewer.last("refused") != nullptr);
  hub.leaves(viewer);
}

namespace {

/// Groups whose light on surfaces was sent in a generation.
std::set<uint32_t> lit_groups(const Remembers& viewer, uint32_t generation) {
  std::set<uint32_t> out;
  for (const LiveFrame& frame : viewer.frames) {
    const FrameHead head = head_of(frame);
    if (head.kind == 2 && head.generation == generation) out.insert(head.a);
  }
  return out;
}

}  // namespace

TEST_CASE(
    "after a move other groups get no new light, late viewers get everything, slow ones what waits",
    "[view]") {
  const test::TemporaryFolder folder;
  Posts posts;
  ViewHub hub(scene_in(folder), small_runs(folder), posts.post());
  Remembers viewer;
  hub.joins(viewer);
  const auto done = [&] {
    const Json* progress = viewer.last("progress");
    return progress != nullptr && (*progress)["done"] == true;
  };
  posts.until(done);
  viewer.waiting = {viewer.frames.back()};
  const FrameHead waited = head_of(viewer.frames.back());
  REQUIRE(waited.a == 1);  // the last frame is of the lamp that stays
  viewer.texts.clear();
  hub.says(viewer, R"({"type":"move","kind":"luminaire","name":"left","position":[1,1,1]})");
  posts.until(done);
  CHECK(lit_groups(viewer, 2) == std::set<uint32_t>{0, 1});
  CHECK(viewer.frames_of(2, 2) > 1);
  const auto again = std::count_if(viewer.frames.begin(), viewer.frames.end(), [](const auto& f) {
    return head_of(f).generation == 2 && head_of(f).a == 1;
  });
  CHECK(again == 1);  // what had not been sent, and nothing else
  Remembers late;
  hub.joins(late);
  CHECK(lit_groups(late, 2) == std::set<uint32_t>{0, 1});
  CHECK(late.frames_of(1, 2) == 1);
  CHECK((*late.last("scene"))["groups"][1]["light"] == "new");
  hub.leaves(late);
  hub.leaves(viewer);
}

namespace {

Sign small_sign(const std::string& name) {
  Sign out;
  out.name = name;
  out.frame.origin = {3, 2, 1};
  out.width_m = 0.4;
  out.height_m = 0.2;
  out.face = {2, 1, {0, 1}, {}};
  return out;
}

const std::string add_left = R"({"type":"add","kind":"luminaire","of":"left","position":[1,1,1]})";

}  // namespace

TEST_CASE(
    "an added luminaire gets light, others keep theirs, and it moves, is saved, and is removed",
    "[view]") {
  Edited live;
  live.says(R"({"type":"factor","group":"left","factor":0.5})");
  live.says(add_left);
  REQUIRE(live.viewer.last("added") != nullptr);
  CHECK(*live.viewer.last("added") ==
        Json({{"type", "added"}, {"kind", "luminaire"}, {"of", "left"}, {"name", "left copy"}}));
  live.until_done();
  CHECK(live.scene()["relaid"] == false);
  CHECK(live.group("left copy")["light"] == "new");
  CHECK(live.group("left copy")["factor"] == 0.5);  // like the original
  CHECK(live.group("left")["light"] == "kept");
  CHECK(live.group("right")["light"] == "kept");
  CHECK(Edited::named(live.scene()["luminaires"], "left copy")["added"] == true);
  CHECK(Edited::named(live.scene()["luminaires"], "left")["added"] == false);
  CHECK(live.viewer.frames_of(1, 2) == 0);
  CHECK(lit_groups(live.viewer, 2).count(2) == 1);
  CHECK(lit_groups(live.viewer, 2).count(0) == 0);
  live.says(R"({"type":"move","kind":"luminaire","name":"left copy","position":[2,1,1]})");
  live.until_done();
  CHECK(live.group("left copy")["light"] == "new");
  CHECK(live.group("right")["light"] == "kept");
  live.says(R"({"type":"save","name":"one more"})");
  const auto saved = read_scene(live.folder / "one more.toml");
  REQUIRE(saved.scene);
  REQUIRE(saved.scene->emitters.size() == 3);
  CHECK(saved.scene->emitters[2].frame.origin == glm::dvec3(2, 1, 1));
  CHECK(saved.scene->emitters[2].mains_flux == 500);
  live.says(R"({"type":"remove","name":"left"})");
  CHECK(live.why().find("only what was added") == 0);
  live.says(R"({"type":"remove","name":"left copy"})");
  live.until_done();
  CHECK(live.scene()["groups"].size() == 2);
  CHECK(live.group("left")["light"] == "kept");
  live.says(R"({"type":"move","kind":"luminaire","name":"left copy","position":[2,1,1]})");
  CHECK(live.why().find("to move") != std::string::npos);
}

TEST_CASE("an added sign changes the triangles, and light of before comes with them", "[view]") {
  const test::TemporaryFolder folder;
  auto scene = std::make_shared<SceneDescription>(*scene_in(folder));
  Sign exit = small_sign("exit");
  exit.colours = white_and_green({100, 10});
  scene->signs.push_back(exit);
  Observer there;
  there.name = "there";
  there.eye = {4, 2, 1};
  there.gaze = {-1, 0, 0};
  scene->observers.push_back(there);
  Edited live(scene);
  const auto light_of = [&](uint32_t generation, uint32_t group) {
    for (const LiveFrame& frame : live.viewer.frames)
      if (const FrameHead head = head_of(frame);
          head.kind == 2 && head.generation == generation && head.a == group)
        return *frame;
    return std::string();
  };
  std::string old;  // the last frame of the left lamp
  for (const LiveFrame& frame : live.viewer.frames)
    if (head_of(frame).kind == 2 && head_of(frame).a == 0) old = *frame;
  live.says(R"({"type":"add","kind":"sign","of":"exit","position":[2,2,1],"facing":[1,0,0]})");
  CHECK((*live.viewer.last("added"))["name"] == "exit copy");
  live.until_done();
  CHECK(live.scene()["relaid"] == true);
  CHECK(live.group("sign exit copy")["light"] == "new");
  CHECK(live.group("left")["light"] == "before");
  CHECK(Edited::named(live.scene()["signs"], "exit copy")["added"] == true);
  CHECK(Edited::named(live.scene()["signs"], "exit")["added"] == false);
  CHECK(live.viewer.frames_of(1, 2) == 1);
  const std::string relaid = light_of(2, 0);
  REQUIRE(relaid.size() == old.size() + 2 * 16);  // the new face has two triangles
  constexpr size_t white = 6;                     // bytes at the end: a white surface in the light
  const size_t of_triangles = old.size() - 16 - white;
  CHECK(relaid.compare(16, of_triangles, old, 16, of_triangles) == 0);
  CHECK(relaid.substr(16 + of_triangles, 2 * 16) == std::string(2 * 16, '\0'));
  CHECK(relaid.substr(relaid.size() - white) == old.substr(old.size() - white));
  // Viewers that join later need no light of before.
  Remembers late;
  live.hub.joins(late);
  CHECK((*late.last("scene"))["relaid"] == false);
  live.hub.leaves(late);
  live.says(R"({"type":"judge","sign":"exit copy"})");
  live.says(R"({"type":"judge","sign":"exit"})");  // waits until the first is assessed
  live.posts.until([&] {
    const Json* verdicts = live.viewer.last("sign");
    return verdicts != nullptr && (*verdicts)["name"] == "exit";
  });
  // Verdicts come with their state.
  CHECK((*live.viewer.last("sign"))["note"].get<std::string>().find("MAINS OPERATION") == 0);
  CHECK(live.viewer.last("refused") == nullptr);
  // A suggestion waits in the same queue; this room has no route that luminaires could light.
  live.says(R"({"type":"suggest","free":[]})");
  live.posts.until([&] { return live.viewer.last("refused") != nullptr; });
  CHECK(live.why().find("nothing to light") != std::string::npos);
  live.says(R"({"type":"remove","name":"exit copy"})");
  live.until_done();
  CHECK(live.scene()["relaid"] == true);
  CHECK(live.scene()["signs"].size() == 1);
  CHECK(live.group("left")["light"] == "before");
  CHECK(light_of(3, 0).size() == old.size());
}

TEST_CASE("verdicts use the nearer frame if the view is between two", "[view][fds]") {
  using namespace test;
  const TemporaryFolder folder;
  const SmallMesh mesh = even_mesh({0, 0, 0}, {1, 1, 1}, {6, 4, 3});
  const auto smoke = [&](float per_m) {
    return cell_values(mesh, [=](int, int, int) { return per_m; });
  };
  const std::string label = "SOOT EXTINCTION COEFFICIENT";
  folder.write("a.sf", slice_file(mesh, label, {{0, smoke(0)}, {10, smoke(8)}}));
  folder.write("fire.smv", index_of_meshes({mesh}) + slice_entry(1, true, mesh, "a.sf", label));
  const std::string file =
      folder.write("scene.toml", live_room +
                                     "[[medium]]\nname = \"fire\"\nkind = \"fds\"\nfile = "
                                     "\"fire.smv\"\nat_s = 4\nalbedo = 0.2\ng = 0.6\nangstrom = 1\n"
                                     "[[observer]]\nname = \"walker\"\neye = [1, 2, 1.6]\n"
                                     "target = [5.9, 2, 2.2]\n"
                                     "[assessment]\nirritant_smoke = false\n");
  const auto shown = described(file);
  const auto verdicts_at = [&](std::optional<double> at_s) {
    Edited live(shown, FrameScenes::of(*shown, file, at_s));
    return live.verdicts_on("exit");
  };
  const auto said = [](const Json& verdicts, const std::string& words) {
    return verdicts["note"].get<std::string>().find(words) != std::string::npos;
  };
  const Json clear = verdicts_at(std::nullopt), dense = verdicts_at(6);
  CHECK(said(clear, "Smoke \"fire\" as at 0 s."));
  CHECK(said(dense, "Smoke \"fire\" as at 10 s."));
  REQUIRE(clear["rows"].size() == 1);
  CHECK(clear["rows"][0]["verdict"] == "legible");
  CHECK(dense["rows"][0]["verdict"] == "invisible");
  // An assessed state is cached: its files are not read again.
  const auto judged = FrameScenes::of(*shown, file, std::nullopt);
  Edited live(shown, judged);
  CHECK(live.verdicts_on("exit")["rows"] == clear["rows"]);
  const auto kept = judged->at(std::nullopt);
  std::filesystem::remove(folder / "a.sf");
  CHECK(live.verdicts_on("exit")["rows"] == clear["rows"]);
  CHECK(judged->at(std::nullopt).value() == kept.value());
  CHECK(FrameScenes::of(*scene_in(folder), file, std::nullopt) == nullptr);
}

TEST_CASE("impossible additions are refused, and their number is limited", "[view]") {
  Edited live;
  live.says(R"({"type":"add","kind":"luminaire","of":"none","position":[1,1,1]})");
  CHECK(live.why().find("to copy") != std::string::npos);
  live.says(R"({"type":"add","kind":"sign","of":"left","position":[1,1,1]})");
  CHECK(live.why().find("to copy") != std::string::npos);
  live.says(R"({"type":"add","kind":"luminaire","of":"left","position":[1,1,1],"facing":[0,0,0]})");
  CHECK(live.viewer.last("added") == nullptr);
  Remembers other;
  live.hub.joins(other);
  live.hub.says(other, add_left);
  CHECK((*other.last("refused"))["why"].get<std::string>().find("somebody else") == 0);
  live.hub.leaves(other);
  for (size_t i = 0; i < limits::view_added; ++i) {
    live.says(add_left);
    REQUIRE(live.viewer.last("added") != nullptr);
  }
  CHECK((*live.viewer.last("added"))["name"] == "left copy 256");
  live.says(add_left);
  CHECK(live.why().find("no more than 256") == 0);
}

TEST_CASE(
    "time after a failure changes shares of light, nothing is traced, and it is refused on mains",
    "[view]") {
  const test::TemporaryFolder folder;
  auto scene = std::make_shared<SceneDescription>(*scene_in(folder));
  scene->emitters[0].emergency_flux = scene->emitters[1].emergency_flux = 100;
  scene->emitters[0].onset = {{0, 0}, {10, 1}};
  Sign glow = small_sign("glow");
  glow.lighting = SignLighting::photoluminescent;
  glow.colours = white_and_green({0, 0}, {1, 0.1});
  glow.decay = {{0, 1}, {10, 0}};
  scene->signs.push_back(glow);
  scene->scenarios.resize(2);
  scene->scenarios[0].name = "failed";
  scene->scenarios[0].operation = Operation::emergency;
  scene->scenarios[1].name = "day";
  Posts posts;
  ViewHub hub(scene, small_runs(folder), posts.post());
  Remembers viewer;
  hub.joins(viewer);
  posts.until([&] { return viewer.last("scene") != nullptr; });
  CHECK((*viewer.last("scene"))["seconds"].is_null());
  hub.says(viewer, R"({"type":"time","seconds":5})");
  REQUIRE(viewer.last("time") != nullptr);
  CHECK((*viewer.last("time"))["seconds"] == 5);
  CHECK((*viewer.last("time"))["shares"]["sign glow"] == 0.5);
  CHECK((*viewer.last("time"))["shares"]["right"] == 1);
  CHECK((*viewer.last("time"))["shares"]["left"] == 0.5);
  Remembers late;
  hub.joins(late);
  CHECK((*late.last("scene"))["seconds"] == 5);
  CHECK((*late.last("scene"))["groups"][2]["share"] == 0.5);
  CHECK((*late.last("scene"))["groups"][2]["factor"] == 1);
  CHECK((*late.last("scene"))["generation"] == 1);
  hub.says(viewer, R"({"type":"scenario","name":"day"})");
  posts.until([&] { return (*viewer.last("scene"))["scenario"] == "day"; });
  hub.says(viewer, R"({"type":"time","seconds":5})");
  REQUIRE(viewer.last("refused") != nullptr);
  CHECK((*viewer.last("scene"))["groups"][0]["share"] == 1);
  hub.leaves(late);
  hub.leaves(viewer);
}

TEST_CASE("a variant is saved under a plain name, and never over a file", "[view]") {
  const test::TemporaryFolder folder;
  Posts posts;
  ViewHub hub(scene_in(folder), small_runs(folder), posts.post());
  Remembers viewer;
  hub.joins(viewer);
  posts.until([&] { return viewer.last("scene") != nullptr; });
  for (const char* name : {"../escape", "a/b", ".hidden", "a.b"}) {
    viewer.texts.clear();
    hub.says(viewer, std::string(R"({"type":"save","name":")") + name + "\"}");
    CHECK(viewer.last("saved") == nullptr);
    CHECK(viewer.last("refused") != nullptr);
  }
  hub.says(viewer, R"({"type":"save","name":"my variant"})");
  REQUIRE(viewer.last("saved") != nullptr);
  CHECK(read_scene(folder / "my variant.toml").scene.has_value());
  viewer.texts.clear();
  hub.says(viewer, R"({"type":"save","name":"my variant"})");
  CHECK((*viewer.last("refused"))["why"].get<std::string>().find("is there already") !=
        std::string::npos);
  hub.leaves(viewer);
}

namespace {

/// With an unlit scenario, which cannot be traced.
const std::string dark_scenario = R"(
[[scenario]]
name = "day"
operation = "mains"

[[scenario]]
name = "night"
operation = "dark"
)";

}  // namespace

TEST_CASE("a refused edit has no effect, and is in no variant", "[view]") {
  const test::LiveRoom of_dark(dark_scenario);
  Edited live(of_dark.scene());
  const uint32_t before = live.scene()["generation"];
  live.says(R"({"type":"scenario","name":"night"})");
  live.posts.until([&] { return live.viewer.last("refused") != nullptr; });
  CHECK(live.why().find("nothing emits light") != std::string::npos);
  CHECK(live.viewer.last("scene") == nullptr);
  // The next edit does not include it.
  live.says(R"({"type":"move","kind":"luminaire","name":"left","position":[1,1,1]})");
  live.posts.until([&] {
    return live.viewer.last("scene") != nullptr || live.viewer.last("refused") != nullptr;
  });
  REQUIRE(live.viewer.last("refused") == nullptr);
  CHECK(live.scene()["generation"] == before + 1);
  CHECK(live.scene()["scenario"] == "day");
  live.says(R"({"type":"save","name":"moved"})");
  INFO(live.answers());
  REQUIRE(live.viewer.last("saved") != nullptr);
  const auto saved = read_scene(live.folder / "moved.toml");
  REQUIRE(saved.scene);
  CHECK(saved.scene->emitters[0].frame.origin == glm::dvec3(1, 1, 1));
}

TEST_CASE("nothing can be moved far outside the building, and a variant keeps its place",
          "[view]") {
  const test::LiveRoom room;
  Edited live(room.scene());
  for (const char* edit :
       {R"({"type":"move","kind":"sign","name":"exit","position":[1e7,0,0],"facing":[1,0,0]})",
        R"({"type":"move","kind":"luminaire","name":"left","position":[0,-1e7,0]})",
        R"({"type":"add","kind":"sign","of":"exit","position":[0,0,1e7]})"}) {
    live.says(edit);
    CHECK(live.why().find("outside of the building") != std::string::npos);
  }
  live.says(R"({"type":"save","name":"near"})");
  INFO(live.answers());
  REQUIRE(live.viewer.last("saved") != nullptr);
  const auto saved = read_scene(live.folder / "near.toml");
  REQUIRE(saved.scene);
  REQUIRE(saved.scene->signs.size() == 1);
  CHECK(saved.scene->signs[0].frame.origin == room.scene()->signs[0].frame.origin);
  CHECK(saved.scene->emitters[0].frame.origin == room.scene()->emitters[0].frame.origin);
}

TEST_CASE("an invalid variant is not saved, whenever it is requested", "[view]") {
  const test::LiveRoom of_dark(dark_scenario);
  Edited live(of_dark.scene());
  // Both at once: the edit has not been checked yet.
  live.says(R"({"type":"scenario","name":"night"})");
  live.hub.says(live.viewer, R"({"type":"save","name":"dark"})");
  CHECK(live.viewer.last("saved") == nullptr);
  REQUIRE(live.viewer.last("refused") != nullptr);
  CHECK(live.why().find("it is not saved") == 0);
  CHECK(std::filesystem::is_empty(live.folder / ""));
}

TEST_CASE("states of a scene with a clock are selectable, and return with their earlier light",
          "[view][time]") {
  const test::TemporaryFolder folder;
  const auto file = folder.write(
      "room.toml", "[time]\nto = 60\nstep = 30\nmains_fail_at = 20\n" + test::two_lamps +
                       "emergency = \"maintained\"\nemergency_factor = 0.5\n"
                       "maintenance_factor = 1\nend_of_duration_factor = 1\nonset = [[0, 0], [20, "
                       "1]]\n"
                       "[[medium]]\nname = \"smoke\"\nkind = \"layered\"\n[[medium.layer]]\n"
                       "z_low = [[0, 3], [60, 1]]\nz_high = 3\nextinction = 0.5\nalbedo = 0.5\n"
                       "[[scenario]]\nname = \"fire\"\noperation = \"emergency\"\n");
  HubOptions options = small_runs(folder);
  int reads = 0;
  options.live.scene_at = [&](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    ++reads;
    ReadScene read = read_scene(file, at_s);
    if (!read.scene) return read.problems.list().front();
    return std::make_shared<const SceneDescription>(std::move(*read.scene));
  };
  options.first.scenario = "fire";
  Posts posts;
  Remembers viewer;
  ViewHub hub(test::described(file), options, posts.post());
  hub.joins(viewer);
  const auto generation = [&] {
    const Json* const scene = viewer.last("scene");
    return scene == nullptr ? uint32_t{0} : (*scene)["generation"].get<uint32_t>();
  };
  const auto done = [&] {
    const Json* const progress = viewer.last("progress");
    return progress != nullptr && (*progress)["generation"] == generation() &&
           (*progress)["done"] == true;
  };
  posts.until([&] { return generation() == 1 && done(); });
  const Json first = *viewer.last("scene");
  CHECK(first["states"]["at"] == 0);
  CHECK(first["states"]["to"] == 60);
  CHECK(first["groups"].size() == 2);  // mains operation
  CHECK(first["scenarios"][0]["operation"] == "mains");
  CHECK(viewer.frames_of(3, 1) == 0);  // no smoke yet

  hub.says(viewer, R"({"type":"state","at":30})");
  posts.until([&] { return generation() == 2 && done(); });
  const Json second = *viewer.last("scene");
  CHECK(second["states"]["at"] == 30);
  CHECK(second["seconds"] == 10);
  REQUIRE(second["groups"].size() == 1);  // the other lamp is not on emergency supply
  CHECK(second["groups"][0]["share"] == 0.5);
  CHECK(viewer.frames_of(3, 2) == 1);
  CHECK(viewer.frames_of(2, 2) > 1);
  const int64_t particles = (*viewer.last("progress"))["particles"].get<int64_t>();

  hub.says(viewer, R"({"type":"state","at":0})");
  posts.until([&] { return generation() == 3 && done(); });
  CHECK((*viewer.last("scene"))["groups"].size() == 2);
  CHECK(viewer.frames_of(2, 3) == 2);  // each group's light once: it was cached

  hub.says(viewer, R"({"type":"state","at":30})");
  posts.until([&] { return generation() == 4 && done(); });
  CHECK((*viewer.last("progress"))["particles"] == particles);
  CHECK(viewer.frames_of(2, 4) == 1);
  CHECK(viewer.frames_of(3, 4) == 1);
  CHECK((*viewer.last("scene"))["seconds"] == 10);
  CHECK(reads == 1);  // the first was opened, the other read once

  hub.says(viewer, R"({"type":"state","at":60})");
  posts.until([&] { return generation() == 5 && done(); });
  CHECK(viewer.frames_of(3, 5) == 1);
  CHECK((*viewer.last("scene"))["groups"][0]["share"] == 1);

  hub.says(viewer, R"({"type":"state","at":61})");
  CHECK((*viewer.last("refused"))["why"].get<std::string>().find("from 0 to 60 s") !=
        std::string::npos);
  hub.leaves(viewer);
}

TEST_CASE("a scene without a clock has one state", "[view][time]") {
  const test::TemporaryFolder folder;
  Posts posts;
  Remembers viewer;
  ViewHub hub(scene_in(folder), small_runs(folder), posts.post());
  hub.joins(viewer);
  posts.until([&] { return viewer.last("scene") != nullptr; });
  CHECK((*viewer.last("scene"))["states"].is_null());
  hub.says(viewer, R"({"type":"state","at":0})");
  CHECK((*viewer.last("refused"))["why"].get<std::string>().find("one state") != std::string::npos);
  hub.leaves(viewer);
}

TEST_CASE("a viewer gets its requested picture of the present building, and no other viewer does",
          "[view]") {
  const test::TemporaryFolder folder;
  Posts posts;
  HubOptions options = small_runs(folder);
  options.pictures = {1e9, 1e9, 1 << 14, 8};
  ViewHub hub(scene_in(folder), options, posts.post());
  Remembers asks, looks;
  hub.joins(asks);
  hub.joins(looks);
  posts.until([&] { return asks.last("progress") != nullptr; });
  const std::string ask =
      R"({"type":"render","id":3,"eye":[1,2,1.6],"target":[5,2,1.6],"up":[0,0,1],"fov":60,)"
      R"("width":24,"height":16,"human":false})";
  const auto picture = [&] {
    const Json* const told = asks.last("picture");
    return told != nullptr && (*told)["done"] == true;
  };
  hub.says(asks, ask);
  posts.until(picture);
  const Json bright = *asks.last("picture");
  CHECK(bright["id"] == 3);
  CHECK(bright["paths"] == 8);
  CHECK(bright["particles"] == 1 << 14);
  // Dimming by viewers applies to the picture.
  hub.says(asks, R"({"type":"factor","factor":0,"group":"left"})");
  asks.texts.clear();
  hub.says(asks, ask);
  posts.until(picture);
  CHECK((*asks.last("picture"))["png"] != bright["png"]);
  // If everything is dark there is none.
  hub.says(asks, R"({"type":"factor","factor":0,"group":"right"})");
  asks.texts.clear();
  hub.says(asks, ask);
  posts.until([&] { return asks.last("refused") != nullptr; });
  CHECK((*asks.last("refused"))["why"].get<std::string>().starts_with("no picture: "));
  CHECK(looks.last("picture") == nullptr);
  hub.leaves(looks);
  hub.leaves(asks);
}
