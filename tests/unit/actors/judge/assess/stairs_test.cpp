// Tests routes over stairs: points of calculation stand on treads wherever the line is drawn, what
// is left out is counted, and each tread needs direct light.
#include "tests/unit/actors/judge/assess/assessed_room.hpp"
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

namespace luxodus {
namespace {

using test::check_of;
using test::stair_room;

std::string lamp(double x, double z) {
  return test::rated_lamp(fmt::format("lamp at {}", x), fmt::format("[{}, 0, {}]", x, z));
}

std::string way(const char* path, double width = 1.2) {
  return fmt::format("[[route]]\nname = \"way\"\npath = [{}]\nwidth = {}\n", path, width);
}

bool has(const Remarks& remarks, RemarkId id) {
  return std::any_of(remarks.begin(), remarks.end(),
                     [&](const Remark& one) { return one.id == id; });
}

Assessment assessed(const std::string& text, const char* rules) {
  AssessOptions options = test::codes_alone();
  options.rules = {rules};
  return test::assessed(text, options);
}

}  // namespace

TEST_CASE("points of a flight stand on its treads, wherever its line is drawn",
          "[assess][stairs]") {
  for (const char* underside : {"none", "solid", "soffit"})
    for (const char* path :
         {"[1, 0, 0], [4, 0, 0], [6.8, 0, 1.7], [11, 0, 1.7]",      // from foot to landing
          "[1, 0, 0], [3.72, 0, 0], [6.52, 0, 1.7], [11, 0, 1.7]",  // along the noses
          "[11, 0, 1.7], [6.8, 0, 1.7], [4, 0, 0], [1, 0, 0]"}) {   // down
      INFO(underside << ": " << path);
      const std::string text = stair_room(underside) + lamp(3, 4.8) + lamp(8, 4.8) + way(path);
      const Assessment a = assessed(text, "en1838-2013");
      const Check& least = check_of(a, RuleId::E1);
      CHECK(*least.value > 1);
      CHECK(least.verdict == CheckVerdict::pass);
      CHECK_FALSE(has(least.conditions, RemarkId::points_in_bodies));
      CHECK(check_of(a, RuleId::E4).verdict == CheckVerdict::pass);
      CHECK(check_of(a, RuleId::E2).verdict == CheckVerdict::pass);
      CHECK(check_of(assessed(text, "en1838-2024"), RuleId::E5).verdict == CheckVerdict::pass);
      for (const PlanLevel& level : a.levels)
        for (const PlanPoint& point : level.points) CHECK(point.lux > 0.5);
      CHECK(inspection::that_say(inspection::found_in(text), "no direct light").empty());
    }
}

TEST_CASE("points of a route in bodies are left out and counted", "[assess][stairs]") {
  // A pillar of 0.6 m stands on the route's right half.
  const std::string pillar =
      "[[object]]\nname = \"pillar\"\nshape = \"box\"\nlow = [8.02, -0.6, 1.7]\nhigh = [8.62, "
      "-0.1, 5]\nmaterial = \"grey50\"\n";
  const std::string path = "[7, 0, 1.7], [11, 0, 1.7]";
  const std::string text =
      stair_room("solid") + lamp(7.5, 4.8) + lamp(10, 4.8) + way(path.c_str(), 1.6);
  const Assessment bare = assessed(text, "en1838-2024"),
                   with = assessed(text + pillar, "en1838-2024");
  CHECK_FALSE(has(check_of(bare, RuleId::E5).conditions, RemarkId::points_in_bodies));
  const Check& inner = check_of(with, RuleId::E5);
  REQUIRE(has(inner.conditions, RemarkId::points_in_bodies));
  CHECK(*inner.value > 0.5);
  // The centre line is free.
  CHECK_FALSE(has(check_of(with, RuleId::E4).conditions, RemarkId::points_in_bodies));
}

TEST_CASE("each tread of a flight needs direct light from some luminaire", "[assess][stairs]") {
  const std::string path = "[1, 0, 0], [4, 0, 0], [6.8, 0, 1.7], [11, 0, 1.7]";
  const Assessment lit =
      assessed(stair_room("solid") + lamp(5, 4.8) + way(path.c_str()), "en1838-2013");
  const Check& passes = check_of(lit, RuleId::E12s);
  CHECK(passes.subject == Subject{SubjectKind::stairs, "way, flight 1"});
  CHECK(passes.verdict == CheckVerdict::pass);
  CHECK(passes.conditions == Remarks{remark(RemarkId::light_of_one_on_treads, 10)});
  // A wall before the flight hides the lamp from its lower treads.
  const std::string wall =
      "[[object]]\nname = \"apron\"\nshape = \"box\"\nlow = [6.2, -2, 3.6]\nhigh = [6.3, 2, "
      "5]\nmaterial = \"grey50\"\n";
  const Assessment dark =
      assessed(stair_room("solid") + wall + lamp(9, 4.8) + way(path.c_str()), "en1838-2013");
  const Check& fails = check_of(dark, RuleId::E12s);
  CHECK(fails.verdict == CheckVerdict::fail);
  CHECK(*fails.value == 0);
  REQUIRE(fails.worst);
  CHECK(fails.worst->x < 6.2);
  // Level ground has no treads.
  const Assessment level = assessed(
      stair_room("solid") + lamp(9, 4.8) + way("[7, 0, 1.7], [11, 0, 1.7]"), "en1838-2013");
  CHECK(std::none_of(level.checks.begin(), level.checks.end(),
                     [](const Check& check) { return check.rule.id == RuleId::E12s; }));
}

}  // namespace luxodus
