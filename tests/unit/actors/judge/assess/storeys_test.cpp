// Tests to which floor a luminaire belongs: the one below it, though a landing beside the room is
// hardly higher than the room's ceiling.
#include "actors/judge/report/schedule.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

namespace luxodus {
namespace {

std::string room(const char* name, const char* low, const char* high) {
  return fmt::format(
      "[[object]]\nname = \"{}\"\nshape = \"room\"\nlow = {}\nhigh = {}\nmaterial = \"black5\"\n",
      name, low, high);
}

const std::string failed = "[[scenario]]\nname = \"failed\"\noperation = \"emergency\"\n";

/// A room with its ceiling at 2.9 m, beside a landing at 2.7 m, which is nearer to its lamp than
/// the area in the room.
const std::string beside_a_landing = room("hall", "[0, -2, 0]", "[8, 2, 2.9]") +
                                     room("landing", "[9, -2, 2.7]", "[14, 2, 5.4]") +
                                     test::rated_lamp("lower", "[7.5, 0, 2.87]") +
                                     test::rated_lamp("upper", "[11, 0, 5.37]") + failed + R"(
[[open_area]]
name = "hall"
outline = [[1, -1.5], [3, -1.5], [3, 1.5], [1, 1.5]]
[[route]]
name = "above"
path = [[9.5, 0, 2.7], [13, 0, 2.7]]
width = 1
[[emphasis]]
name = "hose"
kind = "fire_equipment"
position = [7, 0.5, 0]
)";

}  // namespace

TEST_CASE("a luminaire under a ceiling belongs to the floor below it, not to a landing beside it",
          "[assess][storeys]") {
  const AssessmentRecord a = test::recorded(beside_a_landing, test::codes_alone());
  REQUIRE(a.luminaires.size() == 2);
  CHECK(a.luminaires[0].floor_m.value_or(-1) == Approx(0).margin(1e-5));
  CHECK(a.luminaires[1].floor_m.value_or(-1) == Approx(2.7));
  const Schedule schedule(a);
  REQUIRE(schedule.levels() == 2);
  CHECK(schedule.level_of(a.luminaires[0]) == 0);
  CHECK(schedule.above_floor(a.luminaires[0]) == Approx(2.87));
  CHECK(schedule.level_of(a.luminaires[1]) == 1);
  CHECK(schedule.above_floor(a.luminaires[1]) == Approx(2.67));
  // The storey is no property of a type.
  CHECK(schedule.types().size() == 1);
}

TEST_CASE(
    "a luminaire is near to what is in the room below it, though a landing is as near in plan",
    "[assess][storeys]") {
  const Assessment a = test::assessed(beside_a_landing, test::codes_alone());
  const auto near = std::find_if(a.checks.begin(), a.checks.end(),
                                 [](const Check& check) { return check.rule.id == RuleId::E12; });
  REQUIRE(near != a.checks.end());
  CHECK(near->verdict == CheckVerdict::pass);
  CHECK(near->reasons == Remarks{remark(RemarkId::nearest_luminaire, "lower")});
}

TEST_CASE("a low luminaire stands above its own floor, not above that of the storey below",
          "[assess][storeys]") {
  const Assessment a = test::assessed(room("ground floor", "[0, -2, 0]", "[8, 2, 2.7]") +
                                          room("upper floor", "[0, -2, 2.75]", "[8, 2, 5.4]") +
                                          test::rated_lamp("low", "[4, 0, 2.85]") + failed +
                                          "[[route]]\nname = \"way\"\npath = [[1, 0, 2.75], [7, 0, "
                                          "2.75]]\nwidth = 1\n",
                                      test::codes_alone());
  const auto height = std::find_if(a.checks.begin(), a.checks.end(),
                                   [](const Check& check) { return check.rule.id == RuleId::E14; });
  REQUIRE(height != a.checks.end());
  CHECK(height->value.value_or(-1) == Approx(0.1).margin(1e-4));
  CHECK(height->verdict == CheckVerdict::fail);
}

}  // namespace luxodus
