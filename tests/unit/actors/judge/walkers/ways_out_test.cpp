// Routes of one floor as ways to walk.
#include "actors/judge/walkers/ways_out.hpp"

#include "tests/unit/actors/judge/walkers/walkers_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

double length_of_line(const WalkingLine& line) {
  double out = 0;
  for (size_t i = 1; i < line.size(); ++i) out += glm::distance(line[i - 1], line[i]);
  return out;
}

const std::string two_ways = room_text(20, 6) + route_text("west", "[[10, 3, 0], [1, 3, 0]]") +
                             route_text("east", "[[5, 5, 0], [15, 5, 0], [15, 1, 0], [19, 1, 0]]");

}  // namespace

TEST_CASE("people go to the nearest place of a route and along it to its end", "[walkers]") {
  const Floor floor(two_ways);
  auto ways = WaysOut::make(*floor.scene, *floor.space, 0, 0);
  REQUIRE(ways.ok());
  REQUIRE(ways->ways().size() == 2);
  const auto east = ways->way_named("east");
  REQUIRE(east.ok());
  const auto line = ways->along(east.value(), floor.cell(8.05, 2.05));
  REQUIRE(line);
  CHECK(glm::distance(line->front(), glm::dvec2(8.05, 2.05)) < 1e-9);
  // Up to the line, along it, down its second leg, and to the end: each within a cell.
  CHECK(length_of_line(*line) == Approx(3 + 7 + 4 + 4).margin(0.3));
  CHECK(glm::distance(line->back(), glm::dvec2(19, 1)) < 0.1);
  CHECK(ways->distance_to_end_m(east.value(), floor.cell(8.05, 2.05)) ==
        Approx(std::hypot(10.95, 1.05)).margin(0.1));
}

TEST_CASE("a sign's way goes past its place and on, not back", "[walkers]") {
  const Floor floor(two_ways);
  auto ways = WaysOut::make(*floor.scene, *floor.space, 0, 1);
  REQUIRE(ways.ok());
  const auto east = ways->way_of(floor.scene->routes[1]);
  REQUIRE(east);
  const auto line = ways->past(*east, 12, floor.cell(15.05, 3.05));  // 2 m down the second leg
  REQUIRE(line);
  CHECK(length_of_line(*line) == Approx(2 + 4).margin(0.3));
  CHECK(glm::distance(line->back(), glm::dvec2(19, 1)) < 0.1);
}

TEST_CASE("a route with stairs is left where its line leaves the floor", "[walkers]") {
  const Floor floor(room_text(20, 6) + route_text("up",
                                                  "[[1, 3, 0], [12, 3, 0], [15, 3, 2], "
                                                  "[18, 3, 2]]"));
  const auto ways = WaysOut::make(*floor.scene, *floor.space, 0, 0);
  REQUIRE(ways.ok());
  CHECK(glm::distance(floor.space->centre(ways->ways()[0].end()), glm::dvec2(12, 3)) < 0.1);
  CHECK(ways->ways()[0].to_m == Approx(11));
}

TEST_CASE("a route that cannot be walked is an error that says where", "[walkers]") {
  const auto told = [](const std::string& text, double floor_m, size_t signs) {
    const Floor floor(text);
    const auto ways = WaysOut::make(*floor.scene, *floor.space, floor_m, signs);
    REQUIRE_FALSE(ways.ok());
    return ways.problem().text();
  };
  CHECK_THAT(told(two_ways, 3, 0), Contains("no [[route]] lies on the floor at 3 m"));
  CHECK_THAT(told(room_text(20, 6) + route_text("beyond", "[[1, 3, 0], [22, 3, 0]]"), 0, 0),
             Contains("nobody can stand within 1 m of the end of the route \"beyond\""));
  CHECK_THAT(told(two_ways, 0, 10'000), Contains("give a larger --cell"));
  const Floor floor(two_ways);
  const auto ways = WaysOut::make(*floor.scene, *floor.space, 0, 0);
  REQUIRE(ways.ok());
  CHECK_THAT(ways->way_named("north").problem().text(),
             Contains("no route \"north\" on this floor; there are \"west\", \"east\""));
}

TEST_CASE("a route behind a wall is reached by no way", "[walkers]") {
  const Floor floor(two_ways + box_text("wall", {12, 0, 0}, {12.2, 6, 3}));
  auto ways = WaysOut::make(*floor.scene, *floor.space, 0, 0);
  REQUIRE(ways.ok());
  CHECK(std::isinf(ways->distance_to_end_m(1, floor.cell(3, 3))));
  CHECK_FALSE(ways->along(1, floor.cell(3, 3)));
  CHECK(ways->along(0, floor.cell(3, 3)));
}
