// Tests layouts of rooms and corridors: optima known by formula and symmetry, refused scenes, and
// that every layout on disk passes an assessment.
#include "actors/judge/design/design.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "actors/judge/design/design_files.hpp"
#include "actors/judge/design/record_design.hpp"
#include "runtime/core/random.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

using test::box_room;
using test::designed;
using test::failing_on_disk;
using test::judged_2013;
using test::tried;

std::string problem_of(const std::string& text) {
  const TemporaryFolder folder;
  const auto result = tried(folder.write("scene.toml", text));
  REQUIRE_FALSE(result);
  return result.problem().text();
}

/// A room with furniture and possibly a wall, with a route through it and an area; random by seed.
std::string random_room(uint64_t seed) {
  Random random(seed, RandomStream::test, 7);
  random.start(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform_double();
  };
  const double x = between(6, 16), y = between(4, 9), z = between(2.4, 4);
  std::string out = box_room(x, y, z) + judged_2013;
  const double way = between(1.2, y - 1.2);
  out += fmt::format(
      "[[route]]\nname = \"way\"\npath = [[0.6, {0}, 0], [{1}, {0}, 0]]\n"
      "width = {2}\n",
      way, x - 0.6, between(0.8, 1.8));
  if (random.uniform_double() < 0.6)
    out += fmt::format(
        "[[open_area]]\nname = \"floor\"\noutline = [[0.1, 0.1], [{0}, 0.1], [{0}, "
        "{1}], [0.1, {1}]]\n",
        x - 0.1, y - 0.1);
  if (random.uniform_double() < 0.5) {
    const double at = between(2, x - 3), side = way > y / 2 ? 0.2 : way + 1.1;
    out += fmt::format(
        "[[object]]\nname = \"cupboard\"\nshape = \"box\"\nlow = [{}, {}, 0]\n"
        "high = [{}, {}, {}]\nmaterial = \"grey50\"\ntags = [\"furniture\"]\n",
        at, side, at + 0.8, side + 0.5, between(0.8, 2));
  }
  out += "[[emphasis]]\nname = \"door\"\nkind = \"exit_door\"\nposition = " +
         fmt::format("[{}, {}, 0]\n", x - 0.2, way);
  out += fmt::format("[design]\nspacing_m = {}\nfailure = \"{}\"\n", between(0.9, 1.4),
                     random.uniform_double() < 0.5 ? "two" : "none");
  return out;
}

void check_random_rooms(uint64_t first, uint64_t count) {
  int layouts = 0;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const TemporaryFolder folder;
    const fs::path file = folder.write("scene.toml", random_room(seed));
    INFO("seed " << seed << "\n" << random_room(seed));
    DesignOptions options;
    options.gap = 0.1;
    options.seconds = 60;
    options.what_binds = false;
    const DesignResult result = designed(file, options);
    if (result.answer.layout.empty()) {
      CHECK(result.answer.end == LayoutEnd::infeasible);
      continue;
    }
    ++layouts;
    const auto failing = failing_on_disk(folder, file, result);
    INFO((failing.empty() ? std::string() : failing.front()));
    CHECK(failing.empty());
    CHECK(result.answer.bound <= result.answer.objective + 1e-6);
  }
  CHECK(layouts * 2 > static_cast<int>(count));
}

/// A corridor under spots: their cones are lit, everything else is dark.
std::string spot_corridor(double length) {
  return box_room(length, 2, 3) + judged_2013 + test::spot_of_45_deg +
         fmt::format(R"(
[[route]]
name = "corridor"
path = [[0.5, 1, 0], [{}, 1, 0]]
width = 0.3

[design]
existing = "removed"
failure = "none"
margin = 1
place_tolerance_m = 0
spacing_m = 0.5
)",
                     length - 0.5);
}

}  // namespace

TEST_CASE("a corridor under spots needs its length divided by the width of a cone", "[design]") {
  // A cone of 45 degrees from 2.97 m lights 2 x (2.97 - 0.02) m of the plane at 2 cm. Each of its
  // points gets 300 lm / (2 pi (1 - cos 45 deg)) x cos^3 / h^2 or more: 6.6 lx at the rim.
  constexpr double lit_m = 2 * 2.95;
  for (const double length : {6.0, 13.0, 20.0}) {
    INFO("length " << length);
    const TemporaryFolder folder;
    const DesignResult result = designed(folder.write("scene.toml", spot_corridor(length)));
    REQUIRE(result.answer.end == LayoutEnd::optimal);
    CHECK(result.luminaires.size() == static_cast<size_t>(std::ceil((length - 1) / lit_m)));
    CHECK(result.removed == std::vector<std::string>{"spot"});
  }
}

TEST_CASE("a design needs only routes, since types, places and the scenario have defaults",
          "[design]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", box_room(8, 3, 2.8) + R"(
[[route]]
name = "way"
path = [[1, 1.5, 0], [7, 1.5, 0]]
width = 1.2
[design]
)");
  DesignOptions options;
  options.rules = {"en1838-2024"};
  const DesignResult result = designed(file, options);
  REQUIRE(result.luminaires.size() >= 2);
  CHECK(result.added_scenario);
  CHECK(result.luminaires.front().candidate.position.z == Approx(2.77));
  CHECK(failing_on_disk(folder, file, result).empty());
}

TEST_CASE("a room and its mirror image need equally many luminaires", "[design]") {
  const auto room = [](double from, double to) {
    return box_room(9, 6, 3) + judged_2013 +
           fmt::format(
               "[[route]]\nname = \"way\"\npath = [[{}, 2, 0], [{}, 2, 0]]\nwidth = 1\n"
               "[design]\nspacing_m = 1\n",
               from, to);
  };
  const TemporaryFolder folder;
  const auto there = designed(folder.write("a.toml", room(1, 6)));
  const auto mirrored = designed(folder.write("b.toml", room(8, 3)));
  CHECK(there.answer.objective == Approx(mirrored.answer.objective));
}

TEST_CASE("equal scenes and seeds give equal files", "[design]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", random_room(5));
  const auto scene = test::described(file);
  const auto text = [&] {
    const DesignResult result = designed(file);
    return variant_text(*scene, result, result, folder.path()) +
           json_text(design_json(record_of(*scene, result, "1")));
  };
  CHECK(text() == text());
}

TEST_CASE("full minima after every single failure need at least as many luminaires as the default",
          "[design]") {
  const auto with = [](const char* failure) {
    return box_room(9, 3, 3) + judged_2013 +
           "[[route]]\nname = \"way\"\npath = [[1, 1.5, 0], [8, 1.5, 0]]\nwidth = 1\n[design]\n"
           "failure = \"" +
           failure + "\"\n";
  };
  const TemporaryFolder folder;
  const auto none = designed(folder.write("none.toml", with("none")));
  const auto full = designed(folder.write("full.toml", with("full")));
  CHECK(full.answer.objective >= none.answer.objective);
  // Whichever luminaire fails, 1 lx is left on the whole band: the assessment confirms it.
  for (const Check& check : full.assessment.checks)
    if (check.rule.id == RuleId::F1) CHECK(check.value.value_or(0) >= 1);
}

TEST_CASE("a layout keeps its distance from keep-out zones, signs and walls", "[design]") {
  const TemporaryFolder folder;
  const auto result = designed(folder.write("scene.toml", box_room(10, 3, 3) + judged_2013 + R"(
[[route]]
name = "way"
path = [[1, 1.5, 0], [9, 1.5, 0]]
width = 1
[design]
spacing_m = 0.5
[[design.keep_out]]
name = "smoke detector"
position = [5, 1.5, 3]
radius = 1.2
)"));
  REQUIRE_FALSE(result.luminaires.empty());
  CHECK(result.left_out.keep_out > 0);
  for (const PlacedLuminaire& one : result.luminaires)
    CHECK(glm::length(glm::dvec2(one.candidate.position) - glm::dvec2(5, 1.5)) >= 1.2);
}

TEST_CASE("if no layout exists the demand that cannot hold is named with the reason", "[design]") {
  // A task area needs 15 lx, and the generic luminaire has 112 lm and hangs 6 m above.
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", box_room(4, 4, 7) + judged_2013 + R"(
[[task_area]]
name = "bench"
outline = [[1, 1], [3, 1], [3, 3], [1, 3]]
z = 0.8
mains_lx = 500
[design]
spacing_m = 2
)");
  const DesignResult result = designed(file);
  CHECK(result.answer.end == LayoutEnd::infeasible);
  REQUIRE_FALSE(result.conflict.shortages.empty());
  const auto words = conflict_words(*test::described(file), result);
  REQUIRE_FALSE(words.empty());
  CHECK(words.front().find("bench") != std::string::npos);
  CHECK(words.front().find("times as bright") != std::string::npos);
}

TEST_CASE("an existing luminaire stays if it saves a new one", "[design]") {
  const std::string scene = box_room(9, 3, 3) + judged_2013 + R"(
[[emitter]]
name = "old"
shape = "disc"
diameter = 0.1
position = [4.5, 1.5, 2.97]
flux_lm = 300
emergency = "non-maintained"
emergency_flux = 300
maintenance_factor = 0.8
end_of_duration_factor = 0.7

[[route]]
name = "way"
path = [[1, 1.5, 0], [8, 1.5, 0]]
width = 1

[design]
objective = "cost"
failure = "none"
)";
  const TemporaryFolder folder;
  const fs::path file = folder.write("keep.toml", scene + "existing = \"removable\"\n");
  const auto kept = designed(file);
  const auto renewed = designed(folder.write("go.toml", scene + "existing = \"removed\"\n"));
  CHECK(kept.answer.objective < renewed.answer.objective);
  CHECK(kept.removed.empty());
  CHECK(kept.luminaires.front().name == "old");
  CHECK(renewed.removed == std::vector<std::string>{"old"});
  CHECK(failing_on_disk(folder, file, kept).empty());
}

TEST_CASE("a layout by NFPA 101 has the required means initially and at the end of the duration",
          "[design]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", box_room(9, 3, 2.6) + R"(
[assessment]
rules = ["nfpa101"]
[[route]]
name = "way"
path = [[1, 1.5, 0], [8, 1.5, 0]]
width = 1
[design]
)");
  const DesignResult result = designed(file);
  REQUIRE_FALSE(result.luminaires.empty());
  CHECK(failing_on_disk(folder, file, result).empty());
  for (const Check& check : result.assessment.checks)
    if (check.rule.id == RuleId::N2) CHECK(check.value.value_or(0) >= 1.25 * 6.5 * (1 - 1e-3));
}

TEST_CASE("a scene that cannot be designed is refused with a message", "[design]") {
  const std::string route =
      "[[route]]\nname = \"way\"\npath = [[1, 1.5, 0], [7, 1.5, 0]]\nwidth = 1\n";
  const std::string room = box_room(8, 3, 3) + judged_2013;
  CHECK(problem_of(room).find("nothing to light") != std::string::npos);
  CHECK(problem_of(room + route + "[design]\nwall_clearance_m = 5\n")
            .find("no place for a luminaire") != std::string::npos);
  CHECK(problem_of(box_room(8, 3, 3) + judged_2013 +
                   "[[route]]\nname = \"far\"\npath = [[50, 50, 0], [60, 50, 0]]\nwidth = 1\n")
            .find("far") != std::string::npos);
}

TEST_CASE("layouts of random rooms on disk pass an assessment", "[design]") {
  const char* seed = std::getenv("LUXODUS_SEED");
  check_random_rooms(seed == nullptr ? 1 : std::strtoull(seed, nullptr, 10), 4);
}

TEST_CASE("layouts of 200 random rooms on disk pass an assessment", "[design][.][long]") {
  check_random_rooms(1000, 200);
}

TEST_CASE("a type counts with the flux that its circuit leaves in the judged scenario",
          "[design][circuits]") {
  const auto at = [](const char* factor) {
    std::string text = spot_corridor(13);
    text.insert(text.find("[[emitter]]"), fmt::format("circuits = {{ B = {} }}\n", factor));
    text.insert(text.find("flux_lm"), "circuit = \"B\"\n");
    return text;
  };
  const TemporaryFolder folder;
  const auto count = [&](const char* factor) {
    return designed(folder.write("scene.toml", at(factor))).luminaires.size();
  };
  const size_t all = count("1");
  CHECK(all == 3);
  // The rim of the cone then has less than 1 lx, so the cones have to overlap.
  CHECK(count("0.06") > all);
  const std::string problem = problem_of(at("0"));
  INFO(problem);
  CHECK(problem.find("no type of luminaire gives light") != std::string::npos);
}

TEST_CASE("a failing check that a design does not decide is reported once for all its subjects",
          "[design][files]") {
  std::vector<Check> others;
  const auto add = [&](RuleId rule, const Subject& subject) {
    others.emplace_back();
    others.back().rule.id = rule;
    others.back().subject = subject;
  };
  add(RuleId::E14, {SubjectKind::luminaire, "a"});
  for (int storey = 0; storey < 4; ++storey)
    add(RuleId::N8, {SubjectKind::route, std::to_string(storey)});
  CHECK(
      others_words(others) ==
      std::vector<std::string>{
          "fails, and is not decided here: luminaire \"a\": Height of an emergency luminaire above "
          "the floor",
          "fails, and is not decided here: route \"0\" and 3 others: Distance to the nearest sign, "
          "everywhere on a route"});
  others.pop_back();
  CHECK(others_words(others).size() == 4);
  const Subject hall{SubjectKind::open_area, "hall"}, way{SubjectKind::route, "way"};
  const auto joined =
      joined_by_subject({{"E10f", hall, 4}, {"E6", hall, 4}, {"E5", way, 4}, {"E7", hall, 9}});
  REQUIRE(joined.size() == 3);
  CHECK(joined[0].rule == "E10f, E6");
  CHECK(joined[1].subject == way);
  CHECK(joined[2].points == 9);
}

TEST_CASE("writing a design removes files of an earlier one that it does not have",
          "[design][files]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", spot_corridor(6));
  const auto scene = test::described(file);
  DesignResult result = designed(file);
  REQUIRE(result.signs);
  REQUIRE(write_design(folder.path(), *scene, result, Language::en, "1"));
  CHECK(fs::exists(folder.path() / "signs.csv"));
  folder.write("design.pdf", "of the design before");
  result.signs.reset();
  REQUIRE(write_design(folder.path(), *scene, result, Language::en, "1"));
  CHECK_FALSE(fs::exists(folder.path() / "signs.csv"));
  CHECK_FALSE(fs::exists(folder.path() / "design.pdf"));
}

TEST_CASE("the shortfall off the places is written if a place tolerance is set",
          "[design][files]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", spot_corridor(6));
  DesignResult result = designed(file);
  const auto scene = test::described(file);
  REQUIRE(result.tolerance);
  CHECK_FALSE(record_of(*scene, result, "1").off_place);
  result.tolerance->distance_m = 0.25;
  CHECK(record_of(*scene, result, "1").off_place);
}

}  // namespace luxodus
