// `luxodus assess` on a command line: refusals, the first lines of its output, the effect of
// --strict.
#include <nlohmann/json.hpp>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;

namespace {

/// A short corridor in thin smoke, one luminaire on its ceiling, one sign at its end.
const std::string corridor = R"(
[[object]]
name = "corridor"
shape = "room"
low = [0, 0, 0]
high = [6, 2, 2.8]
material = "grey50"

[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.3
albedo = 0.3

[[emitter]]
name = "em 1"
shape = "point"
distribution = "isotropic"
position = [3, 1, 2.7]
flux_lm = 200
emergency = "non-maintained"
emergency_flux = 200
maintenance_factor = 0.8
emergency_flux_is = "initial"
end_of_duration_factor = 0.7
onset = [[0, 1]]

[[sign]]
name = "exit"
position = [5.95, 1, 2.3]
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.16
mains_white = 500
mains_green = 100
emergency_white = 100
emergency_green = 20

[[route]]
name = "way out"
path = [[0.5, 1, 0], [5.5, 1, 0]]
width = 1.6
)";

const std::string smoky = "[[scenario]]\nname = \"fire\"\n";
const std::string clear =
    "[[scenario]]\nname = \"clear\"\noperation = \"emergency\"\nmedia = { smoke = 0 }\n";
const std::string emergency = "operation = \"emergency\"\n";

Outcome assess(const TemporaryFolder& folder, const std::string& scene,
               const std::string& options) {
  std::ofstream(folder / "scene.toml") << scene;
  return run_luxodus(folder, "assess " + (folder / "scene.toml").string() + " --out " +
                                 (folder / "out").string() + " " + options);
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("assess refuses to run without required options, names them, and writes nothing",
          "[program][assess]") {
  const TemporaryFolder folder;
  const std::string rules = "--rules en1838-2024 ";
  const auto refused = [&](const std::string& scene, const std::string& options,
                           const std::string& words) {
    const Outcome outcome = assess(folder, scene, options);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, words));
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  refused(corridor, rules, "there is no [[scenario]]");
  refused(corridor + smoky + clear, rules, "\"fire\" (mains operation, with smoke)");
  refused(corridor + smoky + emergency, "--codes-alone", "en1838-2013, en1838-2024, nfpa101");
  refused(corridor + smoky + emergency, rules, "irritant_smoke = true");
  refused(corridor + smoky + emergency, "--codes-alone --rules en1838", "no rule set \"en1838\"");
  refused(corridor + smoky + emergency, "--codes-alone --deviation us-ibc " + rules,
          "deviates from none");
}

TEST_CASE("assess states the judged state before any verdict, and never that a building complies",
          "[program][assess]") {
  const TemporaryFolder folder;
  const std::string scene =
      corridor + smoky + emergency + "seconds_after_failure = 5\n" + clear +
      "[assessment]\nirritant_smoke = true\nspacing_m = 4\nrules = [\"en1838-2024\"]\n";
  const Outcome outcome = assess(folder, scene, "--rounds 1");
  INFO(outcome.err << outcome.out);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("\njudged state\n") != std::string::npos);
  CHECK(has(outcome.out, "scenario      fire"));
  CHECK(has(outcome.out, "emergency, 5 s after the failure of the mains"));
  CHECK(has(outcome.out, "1 of 1 lit: em 1"));
  CHECK(has(outcome.out, "extinction 0.3/m at 633 nm"));
  CHECK(has(outcome.out, "EN 1838:2024"));
  CHECK(has(outcome.out, "pupils and retinas have not yet followed"));
  CHECK(outcome.out.find("not assessed") < outcome.out.find("written to"));
  CHECK_FALSE(has(outcome.out, "checks pass"));
  CHECK_FALSE(has(outcome.out, "complies"));
  const std::string page = slurp(folder / "out" / "report.html");
  CHECK(has(page, "1 of 1 lit"));
  CHECK(has(page, "em 1"));
  CHECK_FALSE(has(page, "checks pass"));
}

TEST_CASE("mains operation is judged if it is named, with a warning", "[program][assess]") {
  const TemporaryFolder folder;
  const Outcome outcome =
      assess(folder, corridor + smoky, "--scenario fire --codes-alone --rules en1838-2024");
  CHECK(outcome.code == 0);
  CHECK(has(outcome.err, "MAINS OPERATION"));
  CHECK(has(outcome.out, "MAINS: not an emergency"));
}

TEST_CASE("a limit without a source is reported, and with --strict it is undecided",
          "[program][assess]") {
  const TemporaryFolder folder;
  const std::string scene = corridor + smoky + emergency;
  const Outcome said = assess(folder, scene, "--codes-alone --rules en1838-2024");
  CHECK(said.code == 0);
  CHECK(has(said.out, "  not verified: sign \"exit\": Angle of a sign above the horizontal"));
  CHECK(has(said.out, " 1 not verified"));
  CHECK(assess(folder, scene, "--codes-alone --strict --rules en1838-2024").code == 1);
}

TEST_CASE("nodes give an assessment the light of threads", "[program][assess][nodes]") {
  const TemporaryFolder folder;
  const std::string scene =
      corridor + smoky + emergency +
      "[assessment]\nirritant_smoke = true\nspacing_m = 4\nrules = [\"en1838-2024\"]\n";
  const auto assessed = [&](const std::string& options) {
    const Outcome outcome = assess(folder, scene, "--rounds 1 --overwrite " + options);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    return slurp(folder / "out" / "sights.csv");
  };
  const std::string by_threads = assessed("--threads 1");
  CHECK(has(by_threads, "exit"));
  CHECK(assessed("--nodes 3") == by_threads);
}

TEST_CASE("a red EXIT is assessed by NFPA 101 to the report, and by EN 1838 its colours fail",
          "[program][assess]") {
  const TemporaryFolder folder;
  const std::string scene = std::string(LUX_SOURCE_DIR) + "/scenes/library/red_exit.toml";
  const auto assessed = [&](const std::string& name, const std::string& options) {
    const Outcome outcome =
        run_luxodus(folder, "assess " + scene + " --scenario smoke --rounds 1 --out " +
                                (folder / name).string() + " " + options);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return nlohmann::json::parse(slurp(folder / name / "assessment.json"));
  };
  const auto verdict_of = [](const nlohmann::json& assessment, const std::string& rule) {
    for (const auto& check : assessment["checks"])
      if (check["rule"] == rule) return check["verdict"].get<std::string>();
    return std::string();
  };
  const auto american = assessed("american", "");
  CHECK(verdict_of(american, "N7") == "pass");
  CHECK(verdict_of(american, "N7s") == "pass");
  CHECK(american["signs"][0]["legend"] == "red");
  CHECK(american["signs"][0]["ground"] == "white");
  bool legible = false;
  for (const auto& sight : american["sights"]) legible |= sight["verdict"] == "legible";
  CHECK(legible);
  // Protan eyes see a red legend darker.
  size_t compared = 0;
  for (const auto& sight : american["sights"]) {
    if (!sight.contains("other_eyes")) continue;
    const double level = sight["reading_level"]["value"],
                 error = sight["reading_level"]["standard_error"];
    const auto& protan = sight["other_eyes"][2];
    CHECK(protan["eyes"] == "protan");
    CHECK(sight["chromatic_difference"]["value"].get<double>() > 0);
    if (!(level > 10 * error)) continue;
    CHECK(protan["reading_level"]["value"].get<double>() < level);
    CHECK(sight["other_eyes"][0]["reading_level"]["value"].get<double>() > level);
    ++compared;
  }
  CHECK(compared > 0);
  const std::string page = slurp(folder / "american" / "report.html");
  CHECK(has(page, "red 40 / white 0"));
  const auto european = assessed("european", "--rules en1838-2024");
  CHECK(verdict_of(european, "S8c") == "fail");
  CHECK(has(slurp(folder / "european" / "report.html"),
            "its colours are red, white, not the green and white of ISO 7010"));
}
