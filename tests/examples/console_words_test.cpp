// The program's messages to a designer: whole sentences, names as in the scene, and no internals.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/examples/program_kit.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/room_texts.hpp"

using namespace luxodus::program;
using Catch::Matchers::Contains;
using luxodus::test::replaced;

namespace {

/// A corridor with two signs and two people who see both, and a wall with a long top.
const std::string words_corridor =
    "title = \"A corridor\"\npatch_edge_m = 1\n" + luxodus::test::white_room("[12, 3, 3]") + R"(
[[object]]
name = "low wall"
shape = "box"
low = [3, 2.5, 0]
high = [11, 2.6, 1]
material = "white"
[[emitter]]
name = "lamp"
shape = "rectangle"
position = [6, 1.5, 2.9]
size = [0.6, 0.6]
flux_lm = 3000
emergency_flux = 300
emergency = "maintained"
maintenance_factor = 1
emergency_flux_is = "initial"
end_of_duration_factor = 1
[[medium]]
name = "thin smoke"
kind = "homogeneous"
extinction = 0.1
albedo = 0.5
[[sign]]
name = "exit north"
position = [0.03, 1, 2.2]
facing = [1, 0, 0]
width = 0.4
height = 0.2
texels = 16
file = "sign.svg"
smallest_detail = 0.01
mains_white = 500
mains_green = 100
emergency_white = 50
emergency_green = 10
[[sign]]
name = "exit south"
position = [0.03, 2, 2.2]
facing = [1, 0, 0]
width = 0.4
height = 0.2
texels = 16
file = "sign.svg"
smallest_detail = 0.01
mains_white = 500
mains_green = 100
emergency_white = 50
emergency_green = 10
[[observer]]
name = "walker"
eye = [8, 1.5, 1.6]
target = [0, 1.5, 2.2]
[[observer]]
name = "crawler"
eye = [9, 1.5, 0.5]
target = [0, 1.5, 2.2]
[[plane]]
name = "the floor"
corner = [0, 0, 0.02]
edge_u = [12, 0, 0]
edge_v = [0, 3, 0]
cells = [12, 3]
[[camera]]
name = "before the sign"
eye = [5, 1, 1.6]
target = [0, 1, 2.2]
width = 20
height = 16
[[scenario]]
name = "mains on"
[[scenario]]
name = "mains out"
operation = "emergency"
seconds_after_failure = 90
)";

const std::string sign = R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20">
<rect width="40" height="20" fill="#237F52"/>
<rect x="10" y="5" width="20" height="10" fill="#ffffff"/></svg>
)";

struct Corridor : ScenePlace {
  explicit Corridor(const std::string& text = words_corridor) : ScenePlace("corridor.toml", text) {
    std::ofstream(folder / "sign.svg") << sign;
  }
};

}  // namespace

TEST_CASE("a run's summary gives the state, places, signs by observer and errors by name",
          "[program][words]") {
  const Corridor place;
  const Outcome run = place.run("--no-views --particles 50k --scenario \"mains out\"");
  INFO(run.out << run.err);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.out,
             Contains("scenario \"mains out\": emergency operation 90 s after the failure; "
                      "1 of 1 luminaire lit; 2 of 2 signs lit; smoke: thin smoke"));
  CHECK_THAT(run.out, Contains("plane the floor") && Contains("least/mean") && Contains(" at ("));
  CHECK_THAT(run.out, Contains("signs from walker") && Contains("signs from crawler"));
  CHECK_THAT(run.out, Contains("(median), ") && Contains("(largest: \"the floor\")"));
  CHECK_THAT(run.out, Contains("\" from \""));
  CHECK_THAT(run.out, Contains("absorbed by surfaces") && Contains("by smoke"));
  CHECK(run.out.find("ledger") == std::string::npos);
  const Outcome verbose =
      place.run("--no-views --particles 50k --scenario \"mains out\" --verbose");
  CHECK_THAT(verbose.out, Contains("ledger") && Contains("kernel"));
}

TEST_CASE("files of results have no blanks, and views keep their names", "[program][words]") {
  const Corridor place;
  REQUIRE(place.run("--particles 20k --picture-paths 1 --scenario all").code == 0);
  for (const auto& entry : fs::recursive_directory_iterator(place.out)) {
    INFO(entry.path());
    CHECK(entry.path().filename().string().find(' ') == std::string::npos);
  }
  const fs::path folder = place.out / "mains_out";
  CHECK(fs::exists(folder / "planes" / "the_floor.csv"));
  fs::remove(folder / "views" / "before_the_sign.exr");
  REQUIRE(
      place.luxodus("render " + folder.string() + " --view \"before the sign\" --paths 1").code ==
      0);
  CHECK(fs::exists(folder / "views" / "before_the_sign.exr"));
  const auto result = nlohmann::json::parse(slurp(folder / "result.json"));
  CHECK(result["cameras"][0]["files"][0] == "views/before_the_sign.exr");
  const Outcome unknown = place.luxodus("render " + folder.string() + " --view before");
  CHECK_THAT(unknown.err, Contains("there are: \"before the sign\""));
}

TEST_CASE("check counts signs and observers, and does not list a wall's top as a floor",
          "[program][words]") {
  const Corridor place;
  const Outcome check = place.luxodus("check " + place.scene);
  INFO(check.out);
  CHECK_THAT(check.out, Contains("2 signs seen by 2 observers"));
  CHECK_THAT(check.out, Contains("floors at z = 0 m"));
  // The low wall's top: 8 m long, 0.8 m2; that of a thicker wall has more than a square metre.
  const Corridor thick(replaced(words_corridor, "high = [11, 2.6, 1]", "high = [11, 2.8, 1]"));
  CHECK_THAT(thick.luxodus("check " + thick.scene).out, Contains("floors at z = 0 m"));
  const Corridor table(replaced(words_corridor, "high = [11, 2.6, 1]", "high = [5, 4.5, 1]"));
  CHECK_THAT(table.luxodus("check " + table.scene).out, Contains("floors at z = 0, 1 m"));
  const std::string open =
      replaced(words_corridor, "shape = \"room\"\nlow = [0, 0, 0]\nhigh = [12, 3, 3]",
               "shape = \"quad\"\ncorner = [0, 0, 0]\nedge_u = [0, 0, 3]\n"
               "edge_v = [0, 3, 0]");
  const Corridor none(replaced(open, "high = [11, 2.6, 1]", "high = [3.1, 2.6, 1]"));
  const Outcome no_floor = none.luxodus("check " + none.scene);
  INFO(no_floor.out << no_floor.err);
  CHECK_THAT(no_floor.out, Contains("no floor found"));
}

TEST_CASE("names of scenarios are quoted in lists", "[program][words]") {
  const Corridor place;
  CHECK_THAT(place.run("--scenario mains").err, Contains("there are: \"mains on\", \"mains out\""));
}

TEST_CASE("voxels that are too fine are reported with their key and its line", "[program][words]") {
  const Corridor place(words_corridor + "[run]\nvoxel_edge_m = 0.001\n");
  const Outcome check = place.luxodus("check " + place.scene);
  const std::string text = slurp(place.scene);
  const auto line =
      1 +
      std::count(text.begin(), text.begin() + static_cast<long>(text.find("voxel_edge_m")), '\n');
  INFO(check.err << check.out);
  CHECK(check.code == 2);
  const std::string said = check.err + check.out;
  CHECK_THAT(said, Contains("corridor.toml:" + std::to_string(line) + ":") &&
                       Contains("set voxel_edge_m in [run] to about 0."));
}

TEST_CASE("a misspelt command is reported with the one probably meant", "[program][words]") {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& command) {
    const Outcome wrong = run_luxodus(folder, command);
    CHECK(wrong.code == 2);
    return wrong.err;
  };
  CHECK_THAT(said("chek scene.toml"), Contains("did you mean check?"));
  CHECK_THAT(said("asess"), Contains("did you mean assess?"));
  CHECK_THAT(said("rum"), Contains("did you mean run?"));
  CHECK(said("frobnicate").find("did you mean") == std::string::npos);
}

TEST_CASE("the folder of an assessment is named as such if a run is expected", "[program][words]") {
  const Corridor place;
  fs::create_directories(place.out);
  std::ofstream(place.out / "assessment.json") << "{}";
  const Outcome drawn = place.luxodus("render " + place.out.string());
  const Outcome resumed = place.run("--resume --particles 20k");
  for (const Outcome& refused : {drawn, resumed}) {
    INFO(refused.err);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Contains("folder of an assessment"));
    CHECK(refused.err.find("create the folder first") == std::string::npos);
  }
  CHECK_THAT(place.luxodus("render " + (place.folder / "none").string()).err,
             Contains("there is no result.json here"));
}

TEST_CASE("progress is rare in a pipe, and one line on a terminal", "[program][words]") {
  const Corridor place;
  const Outcome piped = place.run("--no-views --time 3s");
  REQUIRE(piped.code == 0);
  CHECK(piped.err.find("particles,") == std::string::npos);
  if (std::system("script --version >/dev/null 2>&1") != 0) {
    WARN("skipped: no terminal without script(1)");
    return;
  }
  const fs::path typed = place.folder / "typescript";
  const Outcome shown =
      shell(place.folder, "script -qec '" + std::string(LUX_PROGRAM) + " run " + place.scene +
                              " --out " + (place.folder / "shown").string() +
                              " --no-views --time 3s' " + typed.string());
  INFO(slurp(typed));
  CHECK(shown.code == 0);
  CHECK_THAT(slurp(typed), Contains("\r") && Contains("left") && Contains("\033[K"));
}

TEST_CASE("the browser's output while printing is shown only if it fails", "[program][words]") {
  const Corridor place(words_corridor +
                       "[[route]]\nname = \"along\"\npath = [[1, 1, 0], [11, 1, 0]]\n"
                       "width = 1\n");
  const Outcome assessed =
      place.luxodus("assess " + place.scene + " --codes-alone --rules en1838-2013 " +
                    "--scenario \"mains out\" --out " + place.out.string());
  INFO(assessed.err);
  REQUIRE(assessed.code == 0);
  CHECK(assessed.out.find(", )") == std::string::npos);
  const fs::path tools = place.folder / "tools";
  fs::create_directory(tools);
  const auto browser = [&](const std::string& does) {
    std::ofstream(tools / "chromium") << "#!/bin/sh\necho '[ERROR:dbus.cc] no bus' >&2\n" << does;
    fs::permissions(tools / "chromium", fs::perms::owner_all);
    return place.luxodus("report --pdf " + place.out.string(),
                         "env PATH=" + tools.string() + ":/usr/bin:/bin ");
  };
  const Outcome printed = browser(
      "for a in \"$@\"; do case $a in --print-to-pdf=*) echo x >\"${a#*=}\";; esac; done\n");
  CHECK(printed.code == 0);
  CHECK(printed.err.empty());
  // No other browser must be found: fake ones come first under all names.
  for (const char* name : {"chromium-browser", "google-chrome"})
    fs::create_symlink(tools / "chromium", tools / name);
  const Outcome failed = browser("exit 3\n");
  CHECK(failed.code == 2);
  CHECK_THAT(failed.err, Contains("no bus"));
}
