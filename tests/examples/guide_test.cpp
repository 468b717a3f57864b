// The guide as a newcomer follows it: its scene is judged correctly, and each mistake that it lists
// is rejected.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;

namespace {

const fs::path source = LUX_SOURCE_DIR;

std::string guide() {
  return slurp(source / "docs/guide/first-assessment.md");
}

std::string guide_scene() {
  const std::string text = guide();
  const std::string fence = "```toml\n";
  const size_t first = text.find(fence) + fence.size();
  return text.substr(first, text.find("```", first) - first);
}

/// The guide's folder, with `scene` as its scene.
struct WaitingRoom {
  explicit WaitingRoom(const std::string& scene) {
    for (const char* name : {"luminaires/emergency_downlight.ldt", "signs/exit_straight.svg"}) {
      fs::create_directories((folder / name).parent_path());
      fs::copy_file(source / "scenes/library" / name, folder / name);
    }
    std::ofstream(folder / "waiting_room.toml") << scene;
  }
  Outcome assess() const {
    return run_luxodus(folder, "assess " + (folder / "waiting_room.toml").string() + " --out " +
                                   (folder / "out").string());
  }
  nlohmann::json assessment() const {
    return nlohmann::json::parse(slurp(folder / "out" / "assessment.json"));
  }
  TemporaryFolder folder;
};

std::string with(const std::string& what, const std::string& instead) {
  std::string scene = guide_scene();
  const size_t at = scene.find(what);
  REQUIRE(at != std::string::npos);
  return scene.replace(at, what.size(), instead);
}

}  // namespace

TEST_CASE("the guide's room is judged, and its state is printed first", "[program][guide]") {
  const WaitingRoom room(guide_scene());
  const Outcome run = room.assess();
  INFO(run.err);
  REQUIRE(run.code == 0);
  CHECK(
      run.out.starts_with("\"fire\", emergency operation, 60 s after the failure, in smoke of "
                          "0.2/m to 0.8/m ("));
  CHECK(run.out.find(" on lines of sight), by EN 1838:2024: ") < run.out.find("judged state"));
  CHECK(run.out.find("judged state") < run.out.find("lit: "));
  CHECK(run.out.find("EN 1838:2024") != std::string::npos);
  CHECK(run.out.find("complies") == std::string::npos);
  const auto a = room.assessment();
  CHECK(guide().find(a["verdict"]["words"].get<std::string>()) != std::string::npos);
  CHECK(a["state"]["operation"] == "emergency");
  CHECK(a["state"]["luminaires"]["lit"] == 2);
}

TEST_CASE("the guide's room has the illuminance that its luminaires give", "[program][guide]") {
  // Two rotational luminaires 2.95 m above the plane. At the worst places, a metre beyond either of
  // them and half a metre to the side, linear interpolation in the file's table, 0.8 x 0.7 of its
  // flux, and I cos(gamma) / r^2 give 1.6820 lx.
  const WaitingRoom room(guide_scene());
  REQUIRE(room.assess().code == 0);
  const auto a = room.assessment();
  const auto check = std::find_if(a["checks"].begin(), a["checks"].end(),
                                  [](const auto& one) { return one["rule"] == "E5"; });
  REQUIRE(check != a["checks"].end());
  CHECK((*check)["value"].get<double>() == Approx(1.6820).epsilon(1e-3));
  CHECK(std::abs((*check)["worst_place"][0].get<double>() - 4.25) == Approx(3.25));
  CHECK((*check)["verdict"] == "pass");
}

TEST_CASE("each mistake that the guide lists is rejected with a message", "[program][guide]") {
  struct Mistake {
    std::string what, instead, words;
  };
  const std::vector<Mistake> mistakes{
      {"[[scenario]]\nname = \"fire\"\noperation = \"emergency\"\nseconds_after_failure = 60\n", "",
       "[[scenario]]"},
      {"operation = \"emergency\"\nseconds_after_failure = 60\n", "", "operation = \"emergency\""},
      {"rules = [\"en1838-2024\"]\n", "", "en1838-2013, en1838-2024, nfpa101"},
      {"irritant_smoke = true\n", "", "irritant_smoke"},
      {"smallest_detail = 0.012", "smallest_detail = 12", "smallest_detail"},
  };
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.what);
    const WaitingRoom room(with(mistake.what, mistake.instead));
    const Outcome run = room.assess();
    CHECK(run.code != 0);
    CHECK(run.err.find(mistake.words) != std::string::npos);
    CHECK_FALSE(fs::exists(room.folder / "out" / "assessment.json"));
  }
}

namespace {

/// The TOML blocks of a guide, in their order.
std::vector<std::string> toml_blocks(const std::string& text) {
  const std::string fence = "```toml\n";
  std::vector<std::string> blocks;
  for (size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
    at += fence.size();
    blocks.push_back(text.substr(at, text.find("```", at) - at));
  }
  return blocks;
}

}  // namespace

TEST_CASE("the revisions of the guide's project have the verdicts that it states",
          "[program][guide]") {
  const std::string text = slurp(source / "docs/guide/en1838-project.md");
  const std::vector<std::string> blocks = toml_blocks(text);
  REQUIRE(blocks.size() == 2);
  const TemporaryFolder folder;
  const fs::path project = folder / "project";
  fs::create_directories(project);
  fs::create_directories(folder / "scenes");
  fs::create_directory_symlink(source / "scenes/library", folder / "scenes/library");
  const char* const names[] = {"revision_a", "revision_b"};
  for (size_t i = 0; i < 2; ++i) {
    const std::string name = names[i];
    std::ofstream(project / (name + ".toml")) << blocks[i];
    const Outcome run = run_luxodus(folder, "assess " + (project / (name + ".toml")).string() +
                                                " --codes-alone --out " + (folder / name).string());
    INFO(run.err);
    REQUIRE(run.code == 0);
    const auto a = nlohmann::json::parse(slurp(folder / name / "assessment.json"));
    const std::string verdict = a["verdict"]["words"];
    INFO(verdict);
    const size_t count = verdict.find(',');
    CHECK(text.find(verdict.substr(0, count)) != std::string::npos);
    for (const auto& check : a["checks"])
      if (i == 1 && check["verdict"] == "fail") {
        INFO(check["rule"] << " " << check["subject"]);
        const std::string subject = check["subject"]["text"];
        CHECK((subject == "open area \"open plan\"" ||
               subject == "sign \"open-plan east door sign\"" ||
               subject == "luminaire \"stairwell bulkhead 4\""));
      }
  }
}

TEST_CASE("the guide's store room gets the layout that it states, and every command accepts it",
          "[program][guide]") {
  const std::string text = slurp(source / "docs/guide/placement.md");
  const std::vector<std::string> blocks = toml_blocks(text);
  REQUIRE(blocks.size() == 4);
  const TemporaryFolder folder;
  std::ofstream(folder / "store.toml") << blocks[0];
  const std::string layout = (folder / "out").string();
  const Outcome run =
      run_luxodus(folder, "design " + (folder / "store.toml").string() + " --out " + layout);
  INFO(run.out << run.err);
  REQUIRE(run.code == 0);
  const std::string first = run.out.substr(0, run.out.find('\n'));
  CHECK(text.find(first) != std::string::npos);
  for (const char* file :
       {"design.html", "design.json", "luminaires.csv", "signs.csv", "layout.toml",
        "plans/installation.svg", "plans/isolux.svg", "plans/plan.dxf"})
    CHECK(fs::exists(folder / "out" / file));
  const Outcome assessed = run_luxodus(
      folder, "assess " + layout + "/layout.toml --codes-alone --out " + layout + "/assessed");
  INFO(assessed.out << assessed.err);
  REQUIRE(assessed.code == 0);
  const auto a = nlohmann::json::parse(slurp(folder / "out/assessed/assessment.json"));
  for (const auto& check : a["checks"]) CHECK(check["verdict"] != "fail");
}

TEST_CASE("the guide's office floor gets a layout that passes the rules on luminaires",
          "[program][guide]") {
  const std::string text = slurp(source / "docs/guide/placement.md");
  const TemporaryFolder folder;
  const fs::path project = folder / "project";
  fs::create_directories(project);
  fs::create_directories(folder / "scenes");
  fs::create_directory_symlink(source / "scenes/library", folder / "scenes/library");
  // Without failures the search takes a second; the guide states the resulting number of
  // luminaires.
  std::string scene = toml_blocks(text).at(1);
  const std::string spacing = "spacing_m = 1.2\n";
  REQUIRE(scene.find(spacing) != std::string::npos);
  scene.insert(scene.find(spacing), "failure = \"none\"\n");
  std::ofstream(project / "placement.toml") << scene;
  std::ofstream(project / "twenty.toml") << toml_blocks(text).at(2);
  const Outcome twenty = run_luxodus(folder, "check " + (project / "twenty.toml").string());
  INFO(twenty.out << twenty.err);
  CHECK(twenty.code == 0);
  const Outcome run = run_luxodus(folder, "design " + (project / "placement.toml").string() +
                                              " --out " + (folder / "layout").string());
  INFO(run.out << run.err);
  REQUIRE(run.code == 0);
  CHECK(
      run.out.starts_with("7 new luminaires, 10 of the scene stay, 12 go; objective (number) 7, "
                          "the smallest possible with these candidates"));
  CHECK(text.find("with `failure = \"none\"` seven") != std::string::npos);
  for (const char* told : {"112 places, 346 candidates, 2668 points",
                           "planned without furniture, which hides 42 points from all candidates",
                           "fails, and is not decided here: sign \"open-plan east door sign\""}) {
    INFO(told);
    CHECK(run.out.find(told) != std::string::npos);
    CHECK(text.find(std::string(told).substr(0, 31)) != std::string::npos);
  }
  const Outcome assessed =
      run_luxodus(folder, "assess " + (folder / "layout/layout.toml").string() +
                              " --codes-alone --out " + (folder / "assessed").string());
  INFO(assessed.out << assessed.err);
  REQUIRE(assessed.code == 0);
  const auto d = nlohmann::json::parse(slurp(folder / "layout/design.json"));
  std::vector<std::string> told;
  for (const auto& check : d["failing_otherwise"])
    told.push_back(check["rule"].get<std::string>() + check["subject"]["text"].get<std::string>());
  const auto a = nlohmann::json::parse(slurp(folder / "assessed/assessment.json"));
  for (const auto& check : a["checks"])
    if (check["verdict"] == "fail") {
      const std::string one =
          check["rule"].get<std::string>() + check["subject"]["text"].get<std::string>();
      INFO(one);
      CHECK(std::find(told.begin(), told.end(), one) != told.end());
    }
}

TEST_CASE("the guide's imported room gets the luminaires and the sign that it states",
          "[program][guide]") {
  const fs::path model = fs::path(LUX_SHARED_DATA) / "ifc/room_ifc4.ifc";
  if (!fs::exists(model)) {
    WARN("skipped: there is no " << model);
    return;
  }
  const TemporaryFolder folder;
  const std::string house = (folder / "house").string();
  const Outcome import = run_luxodus(folder, "import ifc " + model.string() + " --out " + house);
  if (import.code != 0) {
    WARN("skipped: no model can be imported here: " << import.err);
    return;
  }
  const std::string text = slurp(source / "docs/guide/placement.md");
  std::ofstream(folder / "house/scene.toml", std::ios::app) << toml_blocks(text).at(3);
  const Outcome run =
      run_luxodus(folder, "design " + house + "/scene.toml --out " + (folder / "out").string());
  INFO(run.out << run.err);
  REQUIRE(run.code == 0);
  CHECK(text.find(run.out.substr(0, run.out.find('\n'))) != std::string::npos);
  CHECK(run.out.find("1 new sign, the smallest objective possible") != std::string::npos);
  CHECK(slurp(folder / "out/signs.csv").find("way out: right") != std::string::npos);
}

TEST_CASE("an impossible design writes nothing and says what cannot hold", "[program][guide]") {
  const TemporaryFolder folder;
  std::string scene = toml_blocks(slurp(source / "docs/guide/placement.md")).at(0);
  scene += "[design]\nmargin = 10\nspacing_m = 12\n";
  std::ofstream(folder / "store.toml") << scene;
  const Outcome run = run_luxodus(
      folder, "design " + (folder / "store.toml").string() + " --out " + (folder / "out").string());
  CHECK(run.code == 1);
  CHECK(run.out.find("no layout exists") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out" / "layout.toml"));
}
