// Tests layouts judged in smoke: which one is recommended, and what is reported.
#include "actors/judge/design/smoke_stage.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "actors/judge/design/design_files.hpp"
#include "actors/judge/design/record_design.hpp"
#include "actors/judge/design/smoke_section.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/room_texts.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/kit/walkers.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"
#include "tests/unit/actors/judge/design/smoke_corridor.hpp"

namespace luxodus {
namespace {

using test::nobody;
using test::silent;
namespace fs = std::filesystem;

/// A corridor in smoke with a sign at its end, and places for luminaires of 200 lm.
const std::string smoky = test::corridor_room + test::even_smoke + R"(
[design]
spacing_m = 1.5
failure = "none"
in_smoke = ["fire"]
alternatives = 2
)" + test::corridor_sign;

/// A layout judged so far, legible from between these shares.
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

TEST_CASE("the best layout by the rules is recommended unless another is certainly read more",
          "[design]") {
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

TEST_CASE("a layout counts by the scenario in which it is worst", "[design]") {
  JudgedLayout a = judged_as("A", 4, 0.5, 0.6);
  a.smoke.push_back({"later", {}, {0.2, 0.9}});
  CHECK(a.worst().least == 0.2);
  CHECK(a.worst().most == 0.6);
}

TEST_CASE("the sentences on layouts in smoke follow from their results", "[design]") {
  const Texts english(Language::en);
  const auto told = [&](std::vector<JudgedLayout> layouts) {
    std::string out;
    for (const std::string& line : smoke_words(english, record_of(stage_of(std::move(layouts)))))
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
  // A layout with other signs is not recommended as a layout of luminaires.
  CHECK(stage_of({a, low}).recommended().name == "A");
  CHECK(stage_of({a, low}).with_low_signs()->name == "A low");
  JudgedLayout veiled = judged_as("B", 6, 0.3, 0.4);
  veiled.lost = 5;
  veiled.won = 1;
  const std::string dark = told({a, veiled});
  INFO(dark);
  CHECK(dark.find("Layout B has more light, and from 5 places") != std::string::npos);
  veiled.objective = 4;  // no more luminaires, so no conclusion
  CHECK(told({a, veiled}).find("veils") == std::string::npos);
  for (const Language language : {Language::de, Language::fr})
    CHECK(smoke_words(Texts(language), record_of(stage_of({a, veiled}))).size() >= 2);
  // What ended the elimination rounds, and what is still open.
  SmokeStage ended = stage_of({a, judged_as("B", 4, 0.4, 0.7), judged_as("C", 5, 0.1, 0.2)});
  ended.layouts[0].is_open = ended.layouts[1].is_open = true;
  for (const auto& [end, words] :
       {std::pair{RaceEnd::time, "Time ended the comparison after round 1 of paths: layouts A, B"},
        {RaceEnd::rounds, "After the last round of paths (1) layouts A, B cannot be told apart"},
        {RaceEnd::interrupted, "Interrupted before"}}) {
    ended.end = end;
    CHECK(smoke_words(english, record_of(ended)).back().find(words) != std::string::npos);
  }
}

TEST_CASE("people who walk elsewhere are refused before a layout is sought", "[design][walk]") {
  const test::TemporaryFolder folder;
  DesignOptions options;
  options.people = {test::walker_from({40, 0, 0}, {50, 0, 0}, 8)};
  std::vector<std::string> told;
  const auto result =
      design(test::described(folder.write("scene.toml", smoky)), options, nobody,
             [&](const std::string& what, double, double) { told.push_back(what); });
  REQUIRE_FALSE(result);
  CHECK_THAT(result.problem().text(), Catch::Contains("person 1 of \"people\""));
  CHECK(told == std::vector<std::string>{"inspecting the scene"});
}

TEST_CASE("in a smoky corridor alternatives pass the rules and brighter signs are read farther",
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
  // The sign is read nearby, and not through 15 m of this smoke.
  CHECK(best.worst().most > 0.2);
  CHECK(best.worst().least < 0.9);
  REQUIRE(bright != nullptr);
  CHECK(bright->worst().most >= best.worst().least);
  const JudgedLayout* low = stage.with_low_signs();
  REQUIRE(low != nullptr);
  REQUIRE(low->low_signs.size() == 1);
  CHECK(low->layout.variant->signs.size() == 2);
  // A sign read above is also read together with the sign below.
  CHECK(low->worst().most >= best.worst().least);
  for (const JudgedLayout& one : stage.layouts) {
    INFO(one.name);
    CHECK(one.rounds >= 1);
    CHECK(one.objective <= best.objective * 1.3 + 1e-9);
    CHECK(one.worst().least <= one.worst().most);
  }
  const std::string version = "1";
  const Json json = design_json(record_of(*scene, result.value(), version));
  CHECK(json["smoke"].contains("recommended"));
  // The record is read back whole.
  const auto again = design_of(json);
  INFO((again ? "" : again.problem().what));
  REQUIRE(again);
  CHECK(design_json(again.value()).dump(1) == json.dump(1));
  REQUIRE(write_design(folder.path() / "out", *scene, result.value(), Language::en, version));
  CHECK(fs::exists(folder.path() / "out/alternatives/layout_B.toml"));
  // A later design without smoke removes the layouts of this one.
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
      if (test::is_of_luminaires(check.rule.id)) CHECK(check.verdict != CheckVerdict::fail);
    // The file has the signs that were judged.
    const auto written = test::described(folder.path() / "out" / file_of(one));
    REQUIRE(written->signs.size() == one.layout.variant->signs.size());
    for (size_t i = 0; i < written->signs.size(); ++i) {
      const Sign &there = written->signs[i], &judged = one.layout.variant->signs[i];
      CHECK(there.colours[0].emergency_cd_m2 == Approx(judged.colours[0].emergency_cd_m2));
      CHECK(glm::length(there.frame.origin - judged.frame.origin) < 1e-6);
    }
  }
}

TEST_CASE("layouts are legible from the same shares with shared paths and with their own",
          "[design]") {
  const auto scene = test::described_text(test::corridor_with(test::even_smoke));
  const std::vector<JudgedLayout> layouts{test::corridor_layout(scene, "A", {3, 8, 13}),
                                          test::corridor_layout(scene, "B", {3, 10.5}),
                                          test::corridor_layout(scene, "C", {2, 6, 11, 15})};
  const auto judged = [&](bool together) {
    SmokeStageOptions asked;
    asked.scenarios = {"fire"};
    asked.threads = 2;
    asked.together = together;
    auto stage = judge_in_smoke(layouts, asked, nobody, [](const std::string&) {});
    INFO((stage ? "" : stage.problem().text()));
    REQUIRE(stage);
    return std::move(stage).value();
  };
  const SmokeStage shared = judged(true), apart = judged(false);
  REQUIRE(shared.layouts.size() == 5);  // three, A with brighter signs, A with low ones
  REQUIRE(apart.layouts.size() == 5);
  CHECK(shared.traces == 2);
  CHECK(apart.traces == 5);
  for (size_t i = 0; i < shared.layouts.size(); ++i) {
    const LegibleShare a = shared.layouts[i].worst(), b = apart.layouts[i].worst();
    INFO(shared.layouts[i].name << ": " << a.least << " to " << a.most << ", alone " << b.least
                                << " to " << b.most);
    CHECK(a.least <= b.most + 1e-9);
    CHECK(b.least <= a.most + 1e-9);
    CHECK(shared.layouts[i].rounds >= 1);
    CHECK(shared.layouts[i].guided.empty());  // nothing changes in time
  }
  CHECK((shared.end == RaceEnd::decided || shared.end == RaceEnd::rounds));
}

TEST_CASE("elimination rounds without time judge nothing and say so", "[design]") {
  const auto scene = test::described_text(test::corridor_with(test::even_smoke));
  SmokeStageOptions asked;
  asked.scenarios = {"fire"};
  asked.seconds = 0;
  const auto stage = judge_in_smoke({test::corridor_layout(scene, "A", {3, 8, 13})}, asked, nobody,
                                    [](const std::string&) {});
  REQUIRE(stage);
  CHECK(stage->end == RaceEnd::time);
  CHECK(stage->layouts.empty());
}

TEST_CASE("if smoke sinks, the time until which each layout guides is reported", "[design]") {
  const std::string text = test::corridor_with(
      "[[medium]]\nname = \"smoke\"\nkind = \"layered\"\n[[medium.layer]]\n"
      "z_low = [[0, 3], [100, 1]]\nz_high = 3\nalbedo = 0.3\nextinction = 40\n"
      "[time]\nto = 60\nstep = 15\n");
  const test::TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", text);
  const auto scene_at = [&](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    ReadScene read = read_scene(file, at_s);
    if (!read.scene) return read.problems.list().front();
    return std::make_shared<const SceneDescription>(std::move(*read.scene));
  };
  const auto scene = scene_at(45).value();
  SmokeStageOptions asked;
  asked.scenarios = {"fire"};
  asked.threads = 2;
  asked.scene_at = scene_at;
  const auto stage = judge_in_smoke(
      {test::corridor_layout(scene, "A", {3, 8, 13}), test::corridor_layout(scene, "B", {3, 10.5})},
      asked, nobody, [](const std::string&) {});
  INFO((stage ? "" : stage.problem().text()));
  REQUIRE(stage);
  CHECK(stage->times_s == std::vector<double>{0, 15, 30, 45, 60});
  REQUIRE(stage->layouts.size() == 4);
  // Edges of the sign's letters are at 2.125 and 2.275 m: reached at 43.75 and 36.25 s.
  for (const JudgedLayout& one : stage->layouts) {
    INFO(one.name);
    REQUIRE(one.guided.size() == 1);
    CHECK(one.guided.front().route == "way");
    const FirstLoss loss = first_loss_of(one.guided);
    if (one.low_signs.empty()) {
      CHECK(loss.min_s == 30);
      CHECK(loss.max_s == 30);
      CHECK_FALSE(loss.never_lost);
    } else {
      CHECK(loss.min_s == 60);  // below the smoke
      CHECK(loss.never_lost);
    }
  }
  const Texts english(Language::en);
  DesignRecord record;
  record.objective.kind = "number";
  record.smoke = record_of(stage.value());
  std::string told;
  for (const std::string& line : smoke_words(english, *record.smoke)) told += line + "\n";
  CHECK(told.find("guide from every place of every route until 30 s") != std::string::npos);
  const std::string page = smoke_section(english, record);
  CHECK(page.find("Guides until") != std::string::npos);
  CHECK(page.find("A, until 30 s") != std::string::npos);
  CHECK(page.find("60 s, the last state") != std::string::npos);
}

TEST_CASE("an interrupted computation of guidance keeps the end of the elimination rounds",
          "[design]") {
  const std::string text = test::corridor_with(test::even_smoke + "[time]\nto = 30\nstep = 15\n");
  const test::TemporaryFolder folder;
  const auto scene = test::described(folder.write("scene.toml", text));
  std::atomic<bool> interrupt{false};
  size_t states = 0;
  SmokeStageOptions asked;
  asked.scenarios = {"fire"};
  asked.threads = 2;
  asked.rounds = 1;
  asked.scene_at = [&](double) -> Result<std::shared_ptr<const SceneDescription>> {
    ++states;
    interrupt = true;
    return scene;
  };
  const auto stage = judge_in_smoke({test::corridor_layout(scene, "A", {3, 8, 13})}, asked,
                                    interrupt, [](const std::string&) {});
  INFO((stage ? "" : stage.problem().text()));
  REQUIRE(stage);
  REQUIRE(states > 0);
  CHECK((stage->end == RaceEnd::rounds || stage->end == RaceEnd::decided));
  CHECK(stage->times_s.empty());
  REQUIRE_FALSE(stage->layouts.empty());
  for (const JudgedLayout& one : stage->layouts) CHECK(one.guided.empty());
}

TEST_CASE("the guidance of all routes ends with the one that is lost first", "[design]") {
  const auto guided = [](std::optional<double> least, std::optional<double> most, bool lost) {
    GuidedUntil out;
    out.least = {least, lost ? std::optional(1000.0) : std::nullopt, 0};
    out.most = {most, {}, 0};
    return out;
  };
  const FirstLoss both = first_loss_of({guided(60, 120, true), guided(90, 90, true)});
  CHECK(both.min_s == 60);
  CHECK(both.max_s == 90);
  CHECK_FALSE(both.never_lost);
  CHECK_FALSE(first_loss_of({guided({}, 120, true), guided(90, 90, true)}).min_s.has_value());
  CHECK(first_loss_of({guided(90, 90, false)}).never_lost);
}

TEST_CASE("scenarios that cannot be judged in smoke are refused before the search", "[design]") {
  const auto refused = [](const std::string& text, const std::string& words) {
    const auto result = design_of(text);
    REQUIRE_FALSE(result);
    INFO(result.problem().text());
    CHECK(result.problem().text().find(words) != std::string::npos);
  };
  refused(test::replaced(smoky, "in_smoke = [\"fire\"]", "in_smoke = [\"storm\"]"), "storm");
  refused(test::replaced(smoky, test::even_smoke, ""), "has no smoke");
  std::string unsigned_room = smoky;
  unsigned_room.erase(unsigned_room.find("[[sign]]"));
  refused(unsigned_room, "add [[route]] and [[sign]]");
}

}  // namespace luxodus
