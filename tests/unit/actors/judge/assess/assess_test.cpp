// Assesses a room with one luminaire and one sign, against closed forms, and tests its page.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "actors/judge/assess/assessment_files.hpp"
#include "actors/judge/assess/compare.hpp"
#include "actors/judge/report/report.hpp"
#include "actors/judge/texts/texts.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const Check& check_of(const Assessment& a, const std::string& id, const std::string& condition) {
  for (const Check& check : a.checks)
    if (name_of(check.rule.id) == id &&
        english().remarks(check.conditions).find(condition) != std::string::npos)
      return check;
  FAIL("no check " << id);
  return a.checks.front();
}

}  // namespace

TEST_CASE("the code mode is direct light at the end of the duration, without smoke or reflections",
          "[assess]") {
  // I cos^3 / h^2 for 500 lm x 0.8 x 0.75, 5 m aside, 2.48 m above the plane.
  const double intensity = 300 / (4 * std::numbers::pi), h = 2.5 - 0.02;
  const double expected = intensity * h / std::pow(h * h + 25, 1.5);
  for (const std::string& text : {room, with_smoke(2, 0.3)}) {
    const Assessment a = assessed(text, codes_alone());
    CHECK(*check_of(a, "E1", "without furniture").value == Approx(expected).epsilon(1e-4));
    // The shadow of the table falls on the route.
    CHECK(*check_of(a, "E1", "with furniture").value < 1e-9);
    CHECK(check_of(a, "F1", "\"lamp\" has failed").value == 0.0);
    CHECK(a.sights.empty());
  }
}

TEST_CASE("in absorbing smoke the luminance difference of a sign follows Koschmieder's law",
          "[assess]") {
  AssessOptions options;
  options.rounds = 1;
  const Assessment a = assessed(with_smoke(0.4, 0), options);
  REQUIRE(a.sights.size() == 3);
  for (const SightRow& row : a.sights) {
    const double cosine = std::cos(row.view.angle_deg * std::numbers::pi / 180);
    CHECK(cosine > 0.9);
    CHECK(row.look.transmission == Approx(std::exp(-0.4 * row.view.distance_m)).epsilon(0.01));
    // 100 - 10 cd/m2 of the sign itself, plus the lamp's light on white and green.
    CHECK(row.look.difference.value / row.look.transmission == Approx(90).epsilon(0.02));
    CHECK(row.sight.extinction == Approx(0.4).epsilon(0.02));
  }
}

TEST_CASE("people on routes and in areas represent their whole length and area", "[assess]") {
  AssessOptions options;
  options.rounds = 1;
  const std::string hall =
      "[[open_area]]\nname = \"hall\"\noutline = [[1, -1.5], [9, -1.5], [9, 1.5], [1, 1.5]]\n";
  const Assessment a = assessed(room + hall, options);
  double metres = 0, square_metres = 0;
  for (const SightRow& row : a.sights) {
    const bool on_route = row.from == Subject{SubjectKind::route, "way"};
    (on_route ? metres : square_metres) += row.stands_for;
    CHECK(std::isnan(row.gaze_deg) != on_route);
  }
  CHECK(metres == Approx(10));
  CHECK(square_metres == Approx(24));
  const auto scene = described_text(room + hall);
  const std::string page = report_html(record_of(*scene, a, "1"), {}, {});
  CHECK(page.find("10\u00a0m, 24\u00a0m²") != std::string::npos);  // everything is legible
}

TEST_CASE("a sign is not legible in thick smoke, and a sweep over the density says from where",
          "[assess]") {
  AssessOptions options;
  options.rounds = 2;
  options.smoke_factors = {0, 1, 20};
  const Assessment a = assessed(with_smoke(0.5, 0.3), options);
  std::map<double, int64_t> legible;
  for (const SweepRow& row : a.sweep) {
    CHECK(row.places == 3);
    legible[row.factor] = row.legible;
  }
  CHECK(legible[0] == 3);
  CHECK(legible[1] < 3);
  CHECK(legible[20] == 0);
}

TEST_CASE("equal seeds give equal assessments for any number of threads", "[assess]") {
  AssessOptions one, two;
  one.rounds = two.rounds = 1;
  two.threads = 2;
  const Assessment a = assessed(with_smoke(0.5, 0.3), one);
  const Assessment b = assessed(with_smoke(0.5, 0.3), two);
  REQUIRE(a.sights.size() == b.sights.size());
  for (size_t i = 0; i < a.sights.size(); ++i) {
    CHECK(a.sights[i].look.legend.value == b.sights[i].look.legend.value);
    CHECK(a.sights[i].sight.verdict == b.sights[i].sight.verdict);
  }
}

TEST_CASE("a route outside the building or in a wall is named with its line", "[assess]") {
  const auto broken = [](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    const auto result = tried(text, codes_alone());
    REQUIRE_FALSE(result.ok());
    return result.problem();
  };
  const std::string path = "[[1, 0, 0], [11, 0, 0]]";
  for (const char* wrong : {"[[1, 0, 0], [14, 0, 0]]", "[[1, 0, 1.5], [11, 0, 1.5]]"}) {
    const Problem problem = broken(room, path, wrong);
    CHECK(problem.what.find("route \"way\" has no floor under it") == 0);
    CHECK(problem.where.line > 0);
  }
  const Problem nothing =
      broken(room, "[[route]]\nname = \"way\"\npath = " + path + "\nwidth = 1.6\n", "");
  CHECK(nothing.what.find("nothing to assess") != std::string::npos);
}

namespace {

/// A wall or a closed door across the route at x = 4, without thickness.
std::string across(const std::string& more) {
  return room + "[[object]]\nname = \"leaf\"\nshape = \"quad\"\n" +
         "corner = [4, -2, 0]\nedge_u = [0, 4, 0]\nedge_v = [0, 0, 3]\nmaterial = \"grey50\"\n" +
         more;
}

}  // namespace

TEST_CASE(
    "a route through a wall is refused, and one through a closed door is reported, with both lines",
    "[assess]") {
  const auto refused = tried(across(""), codes_alone());
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("route \"way\" leads through the wall or body \"leaf\" (") ==
        0);
  CHECK(refused.problem().what.find("scene.toml:") != std::string::npos);
  CHECK(refused.problem().where.line > 0);
  const std::string door = "door = { open = false, hinge = [4, -2, 0] }\n";
  const Assessment closed = assessed(across(door), codes_alone());
  // The part behind the door is dark.
  REQUIRE(closed.warnings.size() == 2);
  CHECK(closed.warnings.front().words.find(
            "route \"way\" leads through the closed door \"leaf\"") == 0);
  CHECK(closed.warnings.front().place.line > 0);
  CHECK(closed.warnings.back().words.find("gets no direct light of an emergency luminaire") !=
        std::string::npos);
  AssessOptions options = codes_alone();
  const Assessment open = assessed(across("door = { open = true, hinge = [4, -2, 0] }\n"), options);
  CHECK(open.warnings.empty());
  // Routes may pass around a table.
  CHECK(assessed(room, codes_alone()).warnings.empty());
}

TEST_CASE("a luminaire is near to a point only if a free straight line leads to it", "[assess]") {
  const std::string point =
      "[[emphasis]]\nname = \"call\"\nkind = \"call_point\"\nposition = [4.6, 1.9, 1.2]\n"
      "facing = [0, -1, 0]\n";
  const Assessment open = assessed(room + point, codes_alone());
  CHECK(check_of(open, "E12", "without furniture").reasons ==
        Remarks{remark(RemarkId::nearest_luminaire, "lamp")});
  const std::string wall =
      "[[object]]\nname = \"screen\"\nshape = \"quad\"\ncorner = [5, 1, 0]\n"
      "edge_u = [0, 1, 0]\nedge_v = [0, 0, 3]\nmaterial = \"grey50\"\n";
  const Assessment hidden = assessed(room + point + wall, codes_alone());
  const Check& near = check_of(hidden, "E12", "without furniture");
  CHECK(near.verdict == CheckVerdict::fail);
  CHECK(english().remark(near.reasons.back()) ==
        "\"lamp\" is 2.36 m away, but behind something solid, or shining elsewhere");
}

TEST_CASE("a sign that faces a wall is reported", "[assess]") {
  std::string text = room;
  const std::string facing = "facing = [-1, 0, 0]";
  text.replace(text.find(facing), facing.size(), "facing = [1, 0, 0]");
  const Assessment a = assessed(text, codes_alone());
  REQUIRE_FALSE(a.warnings.empty());
  CHECK(a.warnings.front().words.find("sign \"exit\" faces a wall") == 0);
  CHECK(check_of(a, "S4", "without furniture").verdict == CheckVerdict::fail);
}

TEST_CASE("an assessment is read back, and a comparison lists what has changed", "[assess]") {
  const test::TemporaryFolder folder;
  AssessOptions options;
  options.rounds = 1;
  const AssessmentRecord before = recorded(with_smoke(0.4, 0), options);
  REQUIRE(write_assessment(folder / "a", before).ok());
  const auto again = read_assessment(folder / "a");
  REQUIRE(again.ok());
  CHECK(json_text(assessment_json(again.value())) == json_text(assessment_json(before)));
  const Json nothing = comparison_json(comparison_of(before, again.value()));
  CHECK(nothing.size() == 5);
  for (const auto& [key, rows] : nothing.items()) CHECK(rows.empty());
  std::string dimmer = with_smoke(0.4, 0);
  dimmer.replace(dimmer.find("emergency_flux = 500"), 20, "emergency_flux = 250");
  const Comparison changed = comparison_of(before, recorded(dimmer, options));
  CHECK_FALSE(changed.values.empty());
  CHECK(comparison_text(changed).find("E1 (EN 1838:2013) route \"way\"") != std::string::npos);
  CHECK_FALSE(read_assessment(folder / "").ok());
}

TEST_CASE("writing an assessment removes tables of an earlier one that it does not have",
          "[assess]") {
  const test::TemporaryFolder folder;
  const AssessmentRecord made = recorded(room, codes_alone());
  const auto exists = [&](const char* file) { return std::filesystem::exists(folder / file); };
  REQUIRE(write_assessment(folder.path(), made).ok());
  folder.write("by_guid.csv", "of an earlier assessment\n");
  folder.write("guided.csv", "of an earlier assessment\n");
  folder.write("mine.csv", "a person's\n");
  REQUIRE(write_assessment(folder.path(), made).ok());
  CHECK(exists("checks.csv"));
  CHECK_FALSE(exists("by_guid.csv"));
  CHECK_FALSE(exists("guided.csv"));
  CHECK(exists("mine.csv"));
}

TEST_CASE("a report counts checks, and never says that a building complies", "[assess]") {
  AssessOptions options;
  options.rounds = 1;
  const std::string page = report_html(recorded(room, options), {{{"view", "png"}}, {}}, {});
  CHECK(page.find(" not assessed") != std::string::npos);
  CHECK(page.find("complies with EN") == std::string::npos);
  CHECK(page.find("http-equiv") == std::string::npos);
  CHECK(page.find("src=\"http") == std::string::npos);
  CHECK(page.find("data:image/png;base64,cG5n") != std::string::npos);
  CHECK(page.find("</html>") != std::string::npos);
}
