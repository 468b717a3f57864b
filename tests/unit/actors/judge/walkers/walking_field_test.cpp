// Shortest ways, held against their exact lengths. A body of 0.25 m keeps a cell's half diagonal
// more away from corners than it must, so ways are a little longer, and never shorter.
#include "actors/judge/walkers/walking_field.hpp"

#include "tests/unit/actors/judge/walkers/walkers_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Ways from cell to cell are as long as the exact one to within this share.
constexpr double few_percent = 0.02;

void check_way(const Floor& floor, const glm::dvec2& from, const glm::dvec2& to, double exact_m) {
  const FreeSpace& space = *floor.space;
  const CellNumber begin = floor.cell(from.x, from.y), end = floor.cell(to.x, to.y);
  REQUIRE(glm::distance(space.centre(begin), from) < 1e-9);
  REQUIRE(glm::distance(space.centre(end), to) < 1e-9);
  const WalkingField field(space, {end});
  REQUIRE(field.reaches(begin));
  const auto way = field.way_from(begin);
  CHECK(way.front() == begin);
  CHECK(way.back() == end);
  double length_m = 0;
  for (size_t i = 1; i < way.size(); ++i) {
    CHECK(space.sees(way[i - 1], way[i]));
    length_m += glm::distance(space.centre(way[i - 1]), space.centre(way[i]));
  }
  INFO("exact " << exact_m << ", way " << length_m << ", field " << field.distance_m(begin));
  CHECK(length_m >= exact_m - 1e-9);
  CHECK(length_m <= exact_m * (1 + few_percent));
  CHECK(field.distance_m(begin) >= length_m - 1e-4);
  CHECK(field.distance_m(begin) <= exact_m * (1 + few_percent));
  // The search that ends at the begin knows the same way.
  CHECK(WalkingField(space, {end}, begin).way_from(begin) == way);
}

}  // namespace

TEST_CASE("a way through an empty room is straight", "[walkers]") {
  const Floor floor(room_text(10, 6));
  check_way(floor, {0.55, 0.55}, {9.35, 5.15}, glm::distance(glm::dvec2(0.55), {9.35, 5.15}));
}

TEST_CASE("a way round the corner of a corridor is nearly the shortest", "[walkers]") {
  const Floor floor(room_text(10, 10) + box_text("block", {0, 2, 0}, {8, 10, 3}));
  const glm::dvec2 from(9.05, 9.05), to(0.95, 0.95), corner(8, 2);
  check_way(floor, from, to, way_round(from, corner, corner, to, body_radius_m));
}

TEST_CASE("a way round a pillar is nearly the shortest", "[walkers]") {
  const Floor floor(room_text(10, 6) + box_text("pillar", {4, 2, 0}, {6, 4, 3}));
  // Above the pillar it is a little shorter than below.
  const glm::dvec2 from(1.05, 3.05), to(8.95, 3.05);
  check_way(floor, from, to, way_round(from, {4, 4}, {6, 4}, to, body_radius_m));
}

TEST_CASE("a way through a door is nearly the shortest", "[walkers]") {
  const double width_m = GENERATE(1.0, 0.8);
  const Floor floor(room_text(20, 6) + box_text("south", {9.9, 0, 0}, {10.1, 2.5, 3}) +
                    box_text("north", {9.9, 2.5 + width_m, 0}, {10.1, 6, 3}));
  const glm::dvec2 from(1.05, 1.05), to(18.95, 1.05);
  check_way(floor, from, to, way_round(from, {9.9, 2.5}, {10.1, 2.5}, to, body_radius_m));
}

TEST_CASE("nobody gets through a gap that is narrower than a body", "[walkers]") {
  const Floor floor(room_text(20, 6) + box_text("south", {9.9, 0, 0}, {10.1, 2.5, 3}) +
                    box_text("north", {9.9, 2.95, 0}, {10.1, 6, 3}));
  const WalkingField field(*floor.space, {floor.cell(18, 1)});
  CHECK_FALSE(field.reaches(floor.cell(1, 1)));
  CHECK(std::isinf(field.distance_m(floor.cell(1, 1))));
  CHECK(field.reaches(floor.cell(11, 1)));
}

TEST_CASE("the way to several places is that to the nearest", "[walkers]") {
  const Floor floor(room_text(10, 6) + box_text("wall", {4.9, 0, 0}, {5.1, 5, 3}));
  const CellNumber behind = floor.cell(6.05, 1.05), here = floor.cell(0.55, 4.05);
  const WalkingField field(*floor.space, {behind, here});
  CHECK(field.way_from(floor.cell(4.05, 1.05)).back() == here);
  CHECK(field.way_from(floor.cell(8.05, 5.05)).back() == behind);
  CHECK(field.distance_m(here) == 0);
}
