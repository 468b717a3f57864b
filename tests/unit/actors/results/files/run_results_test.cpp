#include "actors/results/files/run_results.hpp"

#include "actors/results/files/checkpoint.hpp"
#include "actors/results/files/result_files.hpp"
#include "actors/results/pictures/pictures.hpp"
#include "actors/results/run/flux_store.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::string long_name(120, 'n');

/// A room with one value of every kind in the summary, except signs.
const std::string asking_room = R"(
[[material]]
name = "white"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 4, 3]
material = "white"
[[emitter]]
name = "lamp"
shape = "rectangle"
position = [2, 2, 2.9]
size = [0.5, 0.5]
flux_lm = 1000
[[plane]]
name = ")" + long_name + R"("
corner = [0, 0, 0.02]
edge_u = [4, 0, 0]
edge_v = [0, 4, 0]
cells = [4, 4]
[[probe]]
name = "desk"
position = [1, 1, 0.8]
[[surface_group]]
name = "walls"
objects = ["room"]
[[counting_plane]]
name = "half way"
corner = [0, 0, 1.5]
edge_u = [4, 0, 0]
edge_v = [0, 4, 0]
[[camera]]
name = "door"
eye = [0.5, 0.5, 1.6]
target = [2, 2, 1]
width = 8
height = 8
)";

void put(const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

}  // namespace

TEST_CASE("the summary lists every requested value, however long its name", "[display]") {
  const auto run = traced(asking_room, 1 << 15);
  const Json result = result_json(*run, {});
  const std::string text = summary_text(result);
  INFO(text);
  for (const std::string& name : {"plane " + long_name + " mean ", std::string("probe desk"),
                                  std::string("surfaces walls"), std::string("through half way")})
    CHECK(text.find(name) != std::string::npos);
  const size_t plane = text.find(long_name);
  const std::string line = text.substr(plane, text.find('\n', plane) - plane);
  for (const char* part : {" lx", "least ", " at (", "most ", "least/mean "})
    CHECK(line.find(part) != std::string::npos);
}

TEST_CASE("the summary begins with the state, gives the energy balance, and no internals",
          "[display]") {
  const auto run = traced(asking_room, 1 << 15);
  const Json result = result_json(*run, {});
  const std::string text = summary_text(result);
  INFO(text);
  CHECK(text.starts_with("  scenario \"as written\": mains operation; 1 of 1 luminaire lit"));
  // A closed room without smoke: surfaces absorb everything.
  CHECK(text.find("100 % absorbed by surfaces, 0 % by smoke, 0 % escaped") != std::string::npos);
  CHECK(text.find("(largest: \"desk\")") != std::string::npos);
  CHECK(text.find("(largest: \"" + long_name + "\")") != std::string::npos);
  CHECK(text.find("ledger") == std::string::npos);
  CHECK(text.find("2^-32") == std::string::npos);
  const std::string verbose = summary_text(result, true);
  CHECK(verbose.starts_with(text));
  CHECK(verbose.find("closes exactly") != std::string::npos);
}

TEST_CASE("a run of one batch has no error, and the summary has no incomplete sentence",
          "[display]") {
  const auto run = traced(asking_room, 1);
  REQUIRE(run->traced() == 1);
  const std::string text = summary_text(result_json(*run, {}));
  INFO(text);
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find("at most not known") == std::string::npos);
}

TEST_CASE("names in the scene become file names without blanks, and the result lists the files",
          "[display]") {
  std::string text = asking_room;
  text.replace(text.find(long_name), long_name.size(), "under the sign");
  text +=
      "[[camera]]\nname = \"the door\"\neye = [1, 1, 1]\ntarget = [2, 2, 1]\nwidth = 8\n"
      "height = 8\n[[camera]]\nname = \"the_door\"\neye = [1, 1, 1]\ntarget = [2, 2, 1]\n"
      "width = 8\nheight = 8\n";
  const auto run = traced(text, 1 << 13);
  const TemporaryFolder scratch;
  const auto written = write_report(scratch.path(), *run, {"test.toml", "particles", 1});
  REQUIRE(written.ok());
  PictureOptions options;
  options.paths_per_pixel = 2;
  REQUIRE(render_views(scratch.path(), *run, "", options, {}).ok());
  const Json& result = written.value();
  CHECK(result["planes"][0]["name"] == "under the sign");
  CHECK(result["planes"][0]["files"][0] == "planes/under_the_sign.csv");
  CHECK(result["cameras"][1]["files"][0] == "views/the_door.exr");
  CHECK(result["cameras"][2]["files"][0] == "views/the_door-2.exr");
  size_t named = 2;  // result.json and patches.vtp
  for (const char* list : {"planes", "cameras"})
    for (const Json& item : result[list])
      for (const Json& file : item["files"]) {
        CHECK(std::filesystem::exists(scratch.path() / file.get<std::string>()));
        ++named;
      }
  size_t found = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.path())) {
    CHECK(entry.path().filename().string().find(' ') == std::string::npos);
    if (entry.is_regular_file()) ++found;
  }
  CHECK(found == named);
}

TEST_CASE("files that no run has written are refused, those of a run are not", "[display]") {
  const TemporaryFolder scratch;
  const auto run = traced(asking_room, 1 << 13);
  const OutputPlan plan = run_output(*run->scene().description, true);
  CHECK(refuse_foreign_files(scratch.path(), plan).ok());
  const auto refused = [&] {
    const auto done = refuse_foreign_files(scratch.path(), plan);
    return done.ok() ? std::string() : done.problem().text();
  };
  for (const std::string name : {"result.json", "flux.lux", "patches.vtp", "views/door.png"}) {
    put(scratch.path() / name);
    CHECK(refused().find(name) != std::string::npos);
    std::filesystem::remove(scratch.path() / name);
  }
  put(scratch.path() / "notes.txt");  // conflicts with no result
  REQUIRE(write_report(scratch.path(), *run, {"test.toml", "particles", 1}).ok());
  REQUIRE(save_flux(scratch.path() / "flux.lux", *run).ok());
  CHECK(refused().empty());
  // A run that was killed before it had a result.json.
  std::filesystem::remove(scratch.path() / "result.json");
  CHECK(refused().find("flux.lux") == std::string::npos);
}

TEST_CASE("a killed run continues from its checkpoint with the same bits", "[display]") {
  const TemporaryFolder scratch;
  const auto scene = scene_of(asking_room);
  StopRule stop;
  stop.particles = 12 * scene->batch_particles;
  LocalRun whole(scene, 11, 2);
  whole.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
  REQUIRE(save_flux(scratch / "whole.lux", whole).ok());
  std::filesystem::create_directory(scratch / "run");
  int64_t saved = 0;
  {
    // Pauses are checked before every batch, which takes longer than this.
    LocalRun first(scene, 11, 1);
    Checkpoint checkpoint(scratch / "run", first, {"test.toml", "", 1, stop}, 1e-4, 0);
    StopRule part;
    part.particles = 5 * scene->batch_particles;
    first.run(part, std::atomic<bool>{false}, [](const Progress&) {});
    CHECK(checkpoint.taken() > 0);
  }
  const Json begun = Json::parse(file_text(scratch / "run" / "result.json"));
  CHECK(begun["finished"] == false);
  CHECK(begun["scene_file"] == "test.toml");
  LocalRun second(scene, 11, 1);
  REQUIRE(load_flux(scratch / "run" / "flux.lux", second).ok());
  saved = second.traced();
  CHECK(saved > 0);
  CHECK(saved <= 5);
  second.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
  REQUIRE(save_flux(scratch / "second.lux", second).ok());
  CHECK(file_text(scratch / "second.lux") == file_text(scratch / "whole.lux"));
}

TEST_CASE("a checkpoint does not replace a longer run", "[display]") {
  const TemporaryFolder scratch;
  const auto scene = scene_of(asking_room);
  put(scratch / "flux.lux");
  LocalRun run(scene, 11, 1);
  Checkpoint checkpoint(scratch.path(), run, {}, 1e-4, 3 * scene->batch_particles);
  StopRule stop;
  stop.particles = 3 * scene->batch_particles;
  run.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
  CHECK(checkpoint.taken() == 0);
  CHECK(file_text(scratch / "flux.lux") == "x");
  stop.particles = 6 * scene->batch_particles;
  run.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
  CHECK(checkpoint.taken() > 0);
}

TEST_CASE("the worst relative error is the worst of those of planes, probes and signs",
          "[display]") {
  const auto run = traced(asking_room, 1 << 15);
  const Json result = result_json(*run, {});
  const Json& of = result["relative_errors"];
  const auto worst = [&](const char* kind) { return of[kind]["worst"]["value"].get<double>(); };
  const Json& plane = result["planes"][0]["mean_illuminance"];
  CHECK(worst("planes") ==
        Approx(plane["standard_error"].get<double>() / plane["value"].get<double>()));
  CHECK(result["worst_relative_error"]["value"].get<double>() ==
        Approx(std::max(worst("planes"), worst("probes"))));
  CHECK(of["signs"]["median"]["value"].is_null());
}

TEST_CASE("old maps are removed only where a result of ours names them", "[display]") {
  const TemporaryFolder scratch;
  const std::filesystem::path folder = scratch / "run";
  put(folder / "planes" / "floor.csv");
  put(folder / "patches.vtp");
  put(scratch / "outside.csv");
  REQUIRE(remove_old_maps(folder).ok());
  CHECK(std::filesystem::exists(folder / "planes" / "floor.csv"));

  std::ofstream(folder / "result.json")
      << R"({"program": "another", "planes": [{"name": "floor"}]})";
  REQUIRE(remove_old_maps(folder).ok());
  CHECK(std::filesystem::exists(folder / "planes" / "floor.csv"));
  CHECK(std::filesystem::exists(folder / "patches.vtp"));

  std::ofstream(folder / "result.json") << R"({"program": "luxodus", "cameras": 7,
    "planes": [{"name": "floor"}, {"name": "../../outside"}, {"name": 3}, "floor"]})";
  REQUIRE(remove_old_maps(folder).ok());
  CHECK_FALSE(std::filesystem::exists(folder / "planes"));
  CHECK_FALSE(std::filesystem::exists(folder / "patches.vtp"));
  CHECK(std::filesystem::exists(folder / "result.json"));
  CHECK(std::filesystem::exists(scratch / "outside.csv"));
}
