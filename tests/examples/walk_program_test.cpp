// People followed through a scene as a user does it: what `walk` says of each step is held against
// an assessment with an observer at that place, and wrong files are one clear error.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/examples/smoky_corridor.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/small_fire.hpp"

using namespace luxodus::program;
using Catch::Contains;

namespace {

/// Dimmer than the usual sign.
constexpr SignLight dim{60, 200, 30};

/// A corridor of 20 m in smoke of 0.4 /m. A sign over its end in the west, and another behind a
/// wall, which nobody in the corridor sees.
const std::string smoky_way = R"(
[[object]]
name = "corridor"
shape = "room"
low = [0, 0, 0]
high = [20, 4, 3]
material = "grey50"

[[object]]
name = "screen"
shape = "box"
low = [0.5, 2.6, 0]
high = [0.6, 4, 3]
material = "grey50"
)" + lamp_text("[10, 2, 2.97]") +
                              smoke_text(0.4) + sign_text("exit", "[0.02, 1.5, 2.2]", dim) +
                              sign_text("behind the screen", "[0.02, 3.4, 2.2]", dim) +
                              R"(
[assessment]
irritant_smoke = false
rules = ["en1838-2024"]
eye_heights_m = [1.6]

[[scenario]]
name = "fire"
operation = "emergency"
seconds_after_failure = 60
)";

/// A room whose smoke and clock are those of a fire simulation, and two groups of people.
const std::string smoky_room = R"(
[time]
from = 0
to = 20
step = 20
mains_fail_at = 0
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 2, 3]
material = "grey50"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [2, 1, 2.9]
flux_lm = 300
emergency = "maintained"
emergency_flux = 300
emergency_flux_is = "initial"
maintenance_factor = 0.8
end_of_duration_factor = 0.7
[[medium]]
name = "fire"
kind = "fds"
file = "fire.smv"
albedo = 0.2
g = 0.6
angstrom = 1
)" + sign_text("exit", "[0.02, 1, 2.2]") +
                               R"([[people]]
name = "office"
file = "people.txt"
[[people]]
name = "cinema"
file = "people.txt"
luminance_before = 1
[assessment]
irritant_smoke = false
[[scenario]]
name = "fire"
operation = "emergency"
)";

/// Two people who walk west from x = 18.5 for 16 s; the second a metre behind the first.
const std::string two_walkers = [] {
  std::string out = "# framerate: 1\n# id frame x/m y/m z/m\n";
  for (int person = 1; person <= 2; ++person)
    for (int t = 0; t <= 16; ++t)
      out += fmt::format("{} {} {} {} 1.7\n", person, t, 18.5 + person - 1 - t, 1.4);
  return out;
}();

struct SmokyWay {
  explicit SmokyWay(const std::string& more = "", const std::string& without = "")
      : place("corridor.toml", luxodus::test::replaced(smoky_way, without, "") + more) {
    copy_lamp_and_sign(place.folder);
    place.folder.write("people.txt", two_walkers);
  }
  Outcome walk(const std::string& options) const {
    return place.luxodus("walk " + place.scene + " --out " + place.out.string() + " " + options);
  }
  Outcome walk_file(const std::string& text) const {
    return walk("--trajectories " + place.folder.write("given.txt", text).string());
  }
  ScenePlace place;
};

/// The rows of a CSV file without quotes, by the names of its columns.
std::vector<std::map<std::string, std::string>> csv_rows(const fs::path& file) {
  std::vector<std::map<std::string, std::string>> out;
  std::vector<std::string> names;
  std::istringstream lines(slurp(file));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells{""};
    for (const char c : line) {
      if (c == ',')
        cells.emplace_back();
      else if (c != '"')
        cells.back() += c;
    }
    if (names.empty()) {
      names = cells;
      continue;
    }
    REQUIRE(cells.size() == names.size());
    auto& row = out.emplace_back();
    for (size_t i = 0; i < names.size(); ++i) row[names[i]] = cells[i];
  }
  return out;
}

using CsvRow = std::map<std::string, std::string>;

/// Observers where a person was at each step.
std::string observers_along(const std::vector<CsvRow>& steps) {
  std::string out;
  for (const CsvRow& step : steps)
    out += fmt::format(
        "\n[[observer]]\nname = \"at {}\"\neye = [{}, {}, {}]\ntarget = [0.02, 1.5, 2.2]\n",
        step.at("time_s"), step.at("x_m"), step.at("y_m"), step.at("eye_z_m"));
  return out;
}

}  // namespace

TEST_CASE("every step of a walker agrees with an assessment from that place", "[program][walk]") {
  const SmokyWay walked(R"(
[[people]]
name = "guests"
file = "people.txt"
)");
  const Outcome run = walked.walk("");
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.out, Contains("2 people, 34 person-seconds") && Contains("0 % of 64 steps"));
  std::vector<CsvRow> steps;
  for (const CsvRow& row : csv_rows(walked.place.out / "steps.csv"))
    if (row.at("person") == "1") steps.push_back(row);
  REQUIRE(steps.size() == 17);

  const SmokyWay judged(observers_along(steps));
  const Outcome assessed = judged.place.luxodus("assess " + judged.place.scene + " --out " +
                                                judged.place.out.string() + " --no-pictures");
  INFO(assessed.err);
  REQUIRE(assessed.code == 0);
  std::map<std::string, std::map<std::string, std::string>> verdicts;  // by place and sign
  const auto assessment = nlohmann::json::parse(slurp(judged.place.out / "assessment.json"));
  for (const auto& sight : assessment["sights"])
    verdicts[sight["from"]["name"].get<std::string>()][sight["sign"].get<std::string>()] =
        sight["verdict"].get<std::string>();
  size_t decided = 0;
  double read_s = 0;
  for (const CsvRow& step : steps) {
    const auto& here = verdicts.at("at " + step.at("time_s"));
    INFO("at " << step.at("time_s") << ": " << here.at("exit") << ", "
               << here.at("behind the screen"));
    if (step.at("read") == "exit") CHECK(here.at("exit") == "legible");
    if (step.at("seen") == "exit") CHECK(here.at("exit") == "visible but not legible");
    if (step.at("invisible") == "exit") CHECK(here.at("exit") == "invisible");
    CHECK(step.at("hidden") == "behind the screen");
    CHECK(here.at("behind the screen") == "hidden by the building");
    decided += step.at("undecided").empty() ? 1 : 0;
    read_s += step.at("read") == "exit" ? 1 : 0;
    // The smoke is the same everywhere, and nobody's eyes have more than the room has left.
    CHECK(std::stod(step.at("extinction_per_m")) == Approx(0.4).epsilon(1e-3));
    CHECK(std::stod(step.at("facing_deg")) == Approx(180).margin(1e-6));
  }
  CHECK(decided >= 12);  // undecided is right, and says nothing
  CHECK(read_s > 0);
  CHECK(read_s < 17);
  const CsvRow person = csv_rows(walked.place.out / "people.csv").front();
  CHECK(std::stod(person.at("read_s")) == read_s);
  CHECK(std::stod(person.at("mean_extinction_per_m")) == Approx(0.4).epsilon(1e-3));
  const auto json = nlohmann::json::parse(slurp(walked.place.out / "walk.json"));
  REQUIRE(json["people"].size() == 2);
  for (const char* column : {"first_read_s", "last_read_s", "signs_read", "read_s",
                             "mean_extinction_per_m", "largest_equivalent_background_cd_m2"})
    CHECK(json["people"][0][column] == std::stod(person.at(column)));
  const auto curve = csv_rows(walked.place.out / "curve.csv");
  REQUIRE(json["curve"].size() == curve.size());
  for (size_t i = 0; i < curve.size(); ++i)
    CHECK(json["curve"][i]["reading_share"] == std::stod(curve[i].at("reading_share")));
  CHECK(json["steps_through_walls"] == 0);
  CHECK(slurp(walked.place.out / "map.svg").find("</svg>") != std::string::npos);
  CHECK(slurp(walked.place.out / "curve.svg").find("</svg>") != std::string::npos);
}

TEST_CASE("people followed into the folder of an assessment stand in its report",
          "[program][walk]") {
  const SmokyWay scene(
      "\n[[route]]\nname = \"west\"\npath = [[19, 1.4, 0], [1, 1.4, 0]]\nwidth = 1\n");
  const fs::path folder = scene.place.out;
  const Outcome assessed = scene.place.luxodus("assess " + scene.place.scene +
                                               " --codes-alone --out " + folder.string());
  INFO(assessed.err);
  REQUIRE(assessed.code == 0);
  CHECK_THAT(slurp(folder / "report.html"), !Contains("People followed on their way"));
  const std::string people = (scene.place.folder / "people.txt").string();
  const Outcome walked =
      scene.place.luxodus("walk " + scene.place.scene + " --trajectories " + people +
                          " --rounds 1 --out " + (folder / "people").string());
  INFO(walked.err);
  REQUIRE(walked.code == 0);
  REQUIRE(scene.place.luxodus("report " + folder.string()).code == 0);
  CHECK_THAT(slurp(folder / "report.html"),
             Contains("People followed on their way") && Contains("2 people were followed"));
}

TEST_CASE("people who cannot be where the file says are one clear error", "[program][walk]") {
  const SmokyWay scene;
  const auto refused = [&](const std::string& text, const std::string& words) {
    const Outcome run = scene.walk_file(text);
    INFO(run.err);
    CHECK(run.code == 2);
    CHECK_THAT(run.err, Contains(words));
    CHECK_FALSE(fs::exists(scene.place.out / "walk.json"));
  };
  refused("# framerate: 1\n1 0 3 2 0\n", "given.txt:2: the header states no unit of length");
  refused("# framerate: 1\n# id frame x/m y/m z/m\n1 0 300 2 0\n", "outside of the building");
  refused("# framerate: 1\n# id frame x/m y/m z/m\n1 0 0.3 3.5 0\n1 2 2.3 3.5 0\n",
          "of 4 steps of the people cross walls");
  refused("# framerate: 1\n# id frame x/m y/m z/m\n1 0 3 1 0\n1 1000000 3 1 0\n",
          "the people take 1000001 steps of 1 s");
  const Outcome nobody = scene.walk("");
  CHECK(nobody.code == 2);
  CHECK_THAT(nobody.err, Contains("nobody walks in this scene"));
}

TEST_CASE("a time outside of the scene's clock is an error that says what to state",
          "[program][walk]") {
  const SmokyWay scene("\n[time]\nfrom = 0\nto = 10\nstep = 5\nmains_fail_at = 0\n",
                       "seconds_after_failure = 60\n");
  const Outcome run = scene.walk_file(two_walkers);
  INFO(run.err);
  CHECK(run.code == 2);
  CHECK_THAT(run.err,
             Contains("is in the building from 0 to 16 s, and the scene is from 0 to 10 s") &&
                 Contains("time_shift_s"));
}

TEST_CASE("people do not walk in a pack, for which a layout is not sought either",
          "[program][walk][failure]") {
  const SmokyWay scene;
  const std::string pack = (scene.place.folder / "corridor.pack").string();
  const std::string people = (scene.place.folder / "people.txt").string();
  REQUIRE(scene.place.luxodus("pack " + scene.place.scene + " --out " + pack).code == 0);
  const std::string given = " --trajectories " + people;
  for (const std::string& command :
       {"walk " + pack + given, "people " + pack, "design " + pack + given + " --in-smoke fire"}) {
    const Outcome run = scene.place.luxodus(command);
    INFO(command << "\n" << run.err);
    CHECK(run.code == 2);
    CHECK_THAT(run.err, Contains("a pack does not hold all of them"));
  }
}

TEST_CASE("people stand as bodies where they are at a time, if the scene says so",
          "[program][walk]") {
  const SmokyWay scene("\n[time]\nfrom = 0\nto = 20\nstep = 5\nmains_fail_at = 0\n",
                       "seconds_after_failure = 60\n");
  const std::string film =
      scene.place.folder
          .write("film.toml",
                 "include = [\"corridor.toml\"]\npeople_as_bodies = true\n"
                 "[[people]]\nname = \"guests\"\nfile = \"people.txt\"\n"
                 "[[observer]]\nname = \"behind both\"\neye = [19.7, 1.4, 1.6]\n"
                 "target = [0.02, 1.4, 1.6]\n")
          .string();
  const auto lit = [&](const std::string& at) {
    const Outcome run =
        scene.place.luxodus("run " + film + " --at " + at + " --particles 20k --no-views --out " +
                            scene.place.out.string() + at);
    INFO(run.err);
    REQUIRE(run.code == 0);
    return nlohmann::json::parse(slurp(scene.place.out.string() + at + "/result.json"));
  };
  const auto three = lit("3s"), later = lit("19s");
  CHECK(three["scene_hash"] != later["scene_hash"]);
  CHECK(three.dump().find("guests 2 head") != std::string::npos);
  CHECK(later.dump().find("guests 2 head") == std::string::npos);
  const auto refused = [&](const std::string& words, const std::string& why) {
    const Outcome run = scene.place.luxodus(words);
    INFO(run.err);
    CHECK(run.code == 2);
    CHECK_THAT(run.err, Contains(why));
  };
  refused("walk " + film, "would look through their own heads");
  const std::string nobody = scene.place.folder.write(
      "nobody.toml", "include = [\"corridor.toml\"]\npeople_as_bodies = true\n");
  refused("check " + nobody, "needs [[people]]");
  scene.place.folder.write("people.txt", "no header");
  refused("check " + film, "people.txt");
}

TEST_CASE("smoke between two states is linear, and groups come from their own light",
          "[program][walk]") {
  using namespace luxodus::test;
  const ScenePlace room("room.toml", smoky_room);
  SmallMesh mesh = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {8, 4, 6});
  const auto even = [&](float v) { return cell_values(mesh, [v](int, int, int) { return v; }); };
  room.folder.write(
      "a.sf", slice_file(mesh, "SOOT EXTINCTION COEFFICIENT", {{0, even(0)}, {20, even(0.8F)}}));
  room.folder.write(
      "fire.smv",
      index_of_meshes({mesh}) + slice_entry(1, true, mesh, "a.sf", "SOOT EXTINCTION COEFFICIENT"));
  fs::copy_file(fs::path(LUX_SOURCE_DIR) / "scenes/library/signs/exit_straight.svg",
                room.folder / "exit.svg");
  room.folder.write("people.txt",
                    "# framerate: 1\n# id frame x/m y/m z/m\n1 0 3 1 0\n1 20 1 1 0\n");
  const Outcome run = room.luxodus("walk " + room.scene + " --step 5 --out " + room.out.string());
  INFO(run.err);
  REQUIRE(run.code == 0);
  const auto steps = csv_rows(room.out / "steps.csv");
  REQUIRE(steps.size() == 10);
  for (size_t i = 0; i < 5; ++i) {
    INFO(steps[i].at("time_s"));
    CHECK(std::stod(steps[i].at("extinction_per_m")) ==
          Approx(0.04 * 5 * static_cast<double>(i)).margin(1e-6));
    const double office = std::stod(steps[i].at("equivalent_background_cd_m2")),
                 cinema = std::stod(steps[i + 5].at("equivalent_background_cd_m2"));
    CHECK(steps[i + 5].at("group") == "cinema");
    CHECK(office > 10 * cinema);
    CHECK(cinema > 0);
  }
}

TEST_CASE("a sign that is not assessed is undecided, and a warning says so", "[program][walk]") {
  const SmokyWay scene("", "file = \"exit.svg\"\nsmallest_detail = 0.016\n");
  const std::string text = slurp(scene.place.scene);
  std::ofstream(scene.place.scene) << luxodus::test::replaced(
      text, "name = \"exit\"\n", "name = \"exit\"\nplain = \"green\"\nsmallest_detail = 0.02\n");
  const std::string people = (scene.place.folder / "people.txt").string();
  const Outcome run =
      scene.walk("--trajectories " + people + " --step " + GENERATE("1", "0.1 --crowd-hides"));
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK_THAT(run.err, Contains("whether people read the sign \"exit\" is undecided") &&
                          !Contains("\"behind the screen\" is undecided"));
  const auto json = nlohmann::json::parse(slurp(scene.place.out / "walk.json"));
  CHECK(json["people"][0]["first_read_s"].is_null());
  CHECK(json["people"][0]["last_read_s"].is_null());
}
