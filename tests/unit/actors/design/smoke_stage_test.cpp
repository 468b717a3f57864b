// Layouts judged in smoke: which is recommended, and what is told of them.
#include "actors/design/smoke_stage.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "actors/design/design_files.hpp"
#include "actors/design/smoke_section.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/room_texts.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/design/silent.hpp"

namespace luxodus {
namespace {

using test::nobody;
using test::silent;
namespace fs = std::filesystem;

/// A corridor in smoke with a sign at its end, and places for luminaires of 200 lm.
const std::string smoky = R"(
[[object]]
name = "corridor"
shape = "room"
low = [0, -2, 0]
high = [16, 2, 3]
material = "grey50"

[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.4
albedo = 0.6

[assessment]
irritant_smoke = false
spacing_m = 2
eye_heights_m = [1.65]
rules = ["en1838-2013"]

[[route]]
name = "way"
path = [[1, 0, 0], [15, 0, 0]]
width = 1.6

[[scenario]]
name = "fire"
operation = "emergency"

[design]
spacing_m = 1.5
failure = "none"
in_smoke = ["fire"]
alternatives = 2
)" + test::exit_sign_at("[15.95, 0, 2.2]") +
                          "lighting = \"internal\"\n";

/// Judged, so far, as read from between these shares.
JudgedLayout judged_as(const std::string& name, double objective, double least, double most,
                       double sign_factor = 1) {
  JudgedLayout out;
  out.name = name;
  out.objective = objective;
  out.sign_factor = sign_factor;
  out.rounds = 1;
  out.smoke = {{"fire", {}, {least, most}}};
  return out;
}

SmokeStage stage_of(std::vector<JudgedLayout> layouts) {
  SmokeStage out;
  out.scenarios = {"fire"};
  out.layouts = std::move(layouts);
  return out;
}

Result<DesignResult> design_of(const std::string& text) {
  const test::TemporaryFolder folder;
  DesignOptions options;
  options.threads = 2;
  return design(test::described(folder.write("scene.toml", text)), options, nobody, silent);
}

}  // namespace

TEST_CASE("the best by the rules is recommended unless another is surely read more", "[design]") {
  const JudgedLayout a = judged_as("A", 4, 0.5, 0.6);
  CHECK(stage_of({a}).recommended().name == "A");
  CHECK(stage_of({a, judged_as("B", 5, 0.55, 0.9)}).recommended().name == "A");  // undecided
  CHECK(stage_of({a, judged_as("B", 5, 0.7, 0.8)}).recommended().name == "B");
  CHECK(
      stage_of({a, judged_as("B", 5, 0.7, 0.7), judged_as("C", 4, 0.7, 0.8)}).recommended().name ==
      "C");
  CHECK(stage_of({a, judged_as("A+", 4, 0.9, 0.9, 2)}).recommended().name == "A");
  CHECK(stage_of({a, judged_as("A+", 4, 0.9, 0.9, 2)}).with_brighter_signs()->name == "A+");
}

TEST_CASE("a layout counts as in the scenario where it is worst", "[design]") {
  JudgedLayout a = judged_as("A", 4, 0.5, 0.6);
  a.smoke.push_back({"later", {}, {0.2, 0.9}});
  CHECK(a.worst().least == 0.2);
  CHECK(a.worst().most == 0.6);
}

TEST_CASE("what is told of layouts in smoke follows from how they are read", "[design]") {
  const Texts english(Language::en);
  const auto told = [&](std::vector<JudgedLayout> layouts) {
    std::string out;
    for (const std::string& line : smoke_words(english, smoke_json(stage_of(std::move(layouts)))))
      out += line + "\n";
    return out;
  };
  const JudgedLayout a = judged_as("A", 4, 0.5, 0.6);
  const std::string alone = told({a, judged_as("A+", 4, 0.8, 0.9, 2)});
  INFO(alone);
  CHECK(alone.find("50 to 60 % of the routes") != std::string::npos);
  CHECK(alone.find("With no other layout is a sign surely read") != std::string::npos);
  CHECK(alone.find("that helps more than any layout") != std::string::npos);
  JudgedLayout low = judged_as("A low", 4, 0.8, 0.9);
  low.low_signs = {{"exit", {}}, {"west", {}}};
  const std::string below = told({a, low});
  INFO(below);
  CHECK(below.find("2 low-level signs beside the others, 0.3 m above the floor") !=
        std::string::npos);
  CHECK(below.find("from 80 to 90 %: that helps more than any layout") != std::string::npos);
  // With other signs it is no layout of luminaires that could be recommended.
  CHECK(stage_of({a, low}).recommended().name == "A");
  CHECK(stage_of({a, low}).with_low_signs()->name == "A low");
  JudgedLayout veiled = judged_as("B", 6, 0.3, 0.4);
  veiled.lost = 5;
  veiled.won = 1;
  const std::string dark = told({a, veiled});
  INFO(dark);
  CHECK(dark.find("Layout B has more light, and from 5 places") != std::string::npos);
  veiled.objective = 4;  // it has no more luminaires: nothing follows
  CHECK(told({a, veiled}).find("veils") == std::string::npos);
  for (const Language language : {Language::de, Language::fr})
    CHECK(smoke_words(Texts(language), smoke_json(stage_of({a, veiled}))).size() >= 2);
}

TEST_CASE("a corridor in smoke: alternatives pass the rules, brighter signs are read farther",
          "[design]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", smoky);
  const auto scene = test::described(file);
  DesignOptions options;
  options.threads = 2;
  const auto result = design(scene, options, nobody, silent);
  INFO((result ? "" : result.problem().text()));
  REQUIRE(result);
  REQUIRE(result->smoke);
  const SmokeStage& stage = *result->smoke;
  REQUIRE(stage.layouts.size() >= 3);
  const JudgedLayout &best = stage.layouts.front(), *bright = stage.with_brighter_signs();
  CHECK(best.name == "A");
  CHECK(best.placed == result->luminaires.size());
  // The sign is read from near by, and not from the other end of 15 m of this smoke.
  CHECK(best.worst().most > 0.2);
  CHECK(best.worst().least < 0.9);
  REQUIRE(bright != nullptr);
  CHECK(bright->worst().most >= best.worst().least);
  const JudgedLayout* low = stage.with_low_signs();
  REQUIRE(low != nullptr);
  REQUIRE(low->low_signs.size() == 1);
  CHECK(low->layout.variant->signs.size() == 2);
  // What is read above is read with the sign below, too.
  CHECK(low->worst().most >= best.worst().least);
  for (const JudgedLayout& one : stage.layouts) {
    INFO(one.name);
    CHECK(one.rounds >= 1);
    CHECK(one.objective <= best.objective * 1.3 + 1e-9);
    CHECK(one.worst().least <= one.worst().most);
  }
  const std::string version = "1", json = json_text(design_json(*scene, result.value(), version));
  CHECK(json.find("\"recommended\"") != std::string::npos);
  REQUIRE(write_design(folder.path() / "out", *scene, result.value(), Language::en, version));
  CHECK(fs::exists(folder.path() / "out/alternatives/layout_B.toml"));
  // A later design that judges nothing in smoke leaves no layouts of this one.
  DesignResult without = result.value();
  without.smoke.reset();
  const fs::path others = folder.path() / "again/alternatives";
  REQUIRE(write_design(folder.path() / "again", *scene, result.value(), Language::en, version));
  REQUIRE(fs::exists(others / "layout_B.toml"));
  std::ofstream(others / "mine.toml") << "a person's";
  REQUIRE(write_design(folder.path() / "again", *scene, without, Language::en, version));
  CHECK_FALSE(fs::exists(others / "layout_B.toml"));
  CHECK(fs::exists(others / "mine.toml"));
  for (const JudgedLayout& one : stage.layouts) {
    if (file_of(one).empty()) continue;
    AssessOptions asked;
    asked.threads = 2;
    asked.reality = false;
    const auto assessed = assess(test::described(folder.path() / "out" / file_of(one)), asked,
                                 nobody, [](const std::string&, double) {});
    INFO((assessed ? "" : assessed.problem().text()));
    REQUIRE(assessed);
    for (const Check& check : assessed->checks)
      if (is_of_luminaires(check.rule.id)) CHECK(check.verdict != CheckVerdict::fail);
    // The file has the signs that were judged.
    const auto written = test::described(folder.path() / "out" / file_of(one));
    REQUIRE(written->signs.size() == one.layout.variant->signs.size());
    for (size_t i = 0; i < written->signs.size(); ++i) {
      const Sign &there = written->signs[i], &judged = one.layout.variant->signs[i];
      CHECK(there.emergency.white_cd_m2 == Approx(judged.emergency.white_cd_m2));
      CHECK(glm::length(there.frame.origin - judged.frame.origin) < 1e-6);
    }
  }
}

TEST_CASE("what cannot be judged in smoke is refused before the search", "[design]") {
  const auto refused = [](const std::string& text, const std::string& words) {
    const auto result = design_of(text);
    REQUIRE_FALSE(result);
    INFO(result.problem().text());
    CHECK(result.problem().text().find(words) != std::string::npos);
  };
  refused(test::replaced(smoky, "in_smoke = [\"fire\"]", "in_smoke = [\"storm\"]"), "storm");
  std::string clear = smoky;
  const size_t medium = clear.find("[[medium]]"), next = clear.find("[assessment]");
  clear.erase(medium, next - medium);
  refused(clear, "has no smoke");
  std::string unsigned_room = smoky;
  unsigned_room.erase(unsigned_room.find("[[sign]]"));
  refused(unsigned_room, "add [[route]] and [[sign]]");
}

}  // namespace luxodus
