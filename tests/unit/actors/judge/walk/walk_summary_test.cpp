// Followed people in numbers, and the map of where they read nothing.
#include "actors/judge/walk/walk_summary.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/report/people_map.hpp"
#include "actors/judge/walk/walk_files.hpp"
#include "tests/unit/actors/judge/walk/walk_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

WalkStep step_at(double time_s, double x, std::vector<SignOnWay> signs, double unread_s) {
  WalkStep step;
  step.time_s = time_s;
  step.eye = {x, 0.1, 1.6};
  step.signs = std::move(signs);
  step.unread_s = unread_s;
  step.extinction_per_m = x;
  return step;
}

/// Reads sign 0 at 2 s, both signs at 4 s, has an undecided one at 6 s and nothing at 8 s.
WalkedPerson walked_person() {
  const SignOnWay read0{0, SignAnswer::read, false}, read1{1, SignAnswer::read, false},
      perhaps{1, SignAnswer::undecided, false}, behind{0, SignAnswer::hidden, true};
  return {0,
          {step_at(2, 0.1, {read0, perhaps}, 0), step_at(4, 0.2, {read0, read1}, 0),
           step_at(6, 0.7, {perhaps}, 2), step_at(8, 0.8, {behind}, 4)}};
}

}  // namespace

TEST_CASE("the summary of a person adds up the steps", "[walk]") {
  PlacedPerson placed;
  placed.group = "guests";
  placed.id = 4;
  const FollowedPerson s = summary_of(placed, walked_person(), 2);
  CHECK(s.group == "guests");
  CHECK(s.id == 4);
  CHECK(s.from_s == 2);
  CHECK(s.to_s == 8);
  CHECK(s.read_s == 4);
  CHECK(s.undecided_s == 2);
  CHECK(s.unread_s == 2);
  CHECK(s.longest_unread_s == 4);
  CHECK(s.first_read_s == 2.0);
  CHECK(s.last_read_s == 4.0);
  CHECK(s.signs_read == 2);
  CHECK(s.mean_extinction == Approx(0.45));
  CHECK(s.max_extinction == 0.8);
}

TEST_CASE("the summary of a sign counts person-seconds by answer", "[walk]") {
  std::vector<Sign> three(3);
  three[0].name = "exit";
  const auto signs = sign_summaries(three, {walked_person(), walked_person()}, 2);
  REQUIRE(signs.size() == 3);
  CHECK(signs[0].name == "exit");
  CHECK(signs[0].in_view_s == 12);
  CHECK(signs[0].read_s == 8);
  CHECK(signs[0].hidden_s == 4);
  CHECK(signs[0].hidden_by_people_s == 4);
  CHECK(signs[0].readers == 2);
  CHECK(signs[1].undecided_s == 8);
  CHECK(signs[1].seen_s + signs[1].invisible_s == 0);
  CHECK(signs[2].in_view_s == 0);
}

TEST_CASE("the curve counts who is there, at gaps nobody", "[walk]") {
  WalkedPerson later = walked_person();
  for (WalkStep& step : later.steps) step.time_s += 10;
  const auto curve = curve_of({walked_person(), later}, 2);
  REQUIRE(curve.size() == 9);  // 2 to 18 s
  CHECK(curve[0].present == 1);
  CHECK(curve[0].reading_share() == 1.0);
  CHECK(curve[2].undecided == 1);
  CHECK(curve[4].time_s == 10);
  CHECK(curve[4].present == 0);
  CHECK_FALSE(curve[4].reading_share());
}

TEST_CASE("cells of the floor count person-seconds without a sign read", "[walk]") {
  std::vector<PlacedPerson> people{walker_from({0, 0, 0}, {1, 0, 0}, 8)};
  PlanLevel upper;
  upper.floor_m = 3;
  const auto floors = walked_floors({{}, upper}, people, {walked_person()}, 2);
  REQUIRE(floors.size() == 2);
  CHECK(floors[1].floor_m == 3);
  CHECK(floors[1].cells.empty());
  REQUIRE(floors[0].cells.size() == 2);
  CHECK(floors[0].cells[0].corner == glm::dvec2(0, 0));
  CHECK(floors[0].cells[0].unread_s == 0);
  CHECK(floors[0].cells[1].corner == glm::dvec2(0.5, 0));
  CHECK(floors[0].cells[1].unread_s == 4);
  PlanLevel level;
  level.walls = {{{0, 0}, {10, 0}}};
  const std::string svg = people_map(level, floors[0], counted_cell_m, english()).svg;
  CHECK(svg.find("#cfe3d4") != std::string::npos);  // always read
  CHECK(svg.find("#e59a4c") != std::string::npos);  // 2 to 10 person-seconds without
  CHECK_THAT(svg, Catch::EndsWith("</svg>\n"));
}

TEST_CASE("the animation moves people in their times and colours", "[walk]") {
  WalkedPerson later = walked_person();
  for (WalkStep& step : later.steps) step.time_s += 6;
  const WalkedPerson first = walked_person();
  const std::string svg = walk_animation({}, {&first, &later}, 2);
  // 12 s in 3 s; the second person comes in half way, and the first has then left.
  CHECK(svg.find("dur=\"3.00s\"") != std::string::npos);
  CHECK(svg.find("keyTimes=\"0.00000;0.16667;0.33333;0.50000;1.00000\"") != std::string::npos);
  CHECK(svg.find("values=\"#2f8f5b;#2f8f5b;#e0b23a;#4a2a33;#4a2a33\"") != std::string::npos);
  CHECK(svg.find("keyTimes=\"0;0.50000\" values=\"hidden;visible\"") != std::string::npos);
  CHECK(svg.find("keyTimes=\"0.00000;0.66667\" values=\"visible;hidden\"") != std::string::npos);
  CHECK(level_files("animation", 1) == std::vector<std::string>{"animation.svg"});
  CHECK(level_files("map", 2) == std::vector<std::string>{"map_1.svg", "map_2.svg"});
}
