#include "scenes/emergency/way.hpp"

#include <catch2/catch.hpp>

#include "scenes/emergency/calculation_grid.hpp"

using namespace luxodus;

namespace {

EscapeRoute bent() {
  EscapeRoute route;
  route.name = "bent";
  route.path = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}};
  route.width_m = 2;
  return route;
}

}  // namespace

TEST_CASE("points on a line are evenly spaced, include the ends, and contain each corner once",
          "[emergency][way]") {
  const EscapeRoute route = bent();
  CHECK(length_of(route) == Approx(7));
  CHECK(is_level(route));
  const auto points = along(route, 0, 1);
  REQUIRE(points.size() == 8);
  CHECK(points.front() == glm::dvec3(0, 0, 0));
  CHECK(points.back() == glm::dvec3(4, 3, 0));
  const auto left = along(route, 0.5, 10);
  REQUIRE(left.size() == 4);  // both ends of both legs, which do not meet
  CHECK(left[0] == glm::dvec3(0, 0.5, 0));
  CHECK(left[2] == glm::dvec3(3.5, 0, 0));
}

TEST_CASE("a ramp is not a level route", "[emergency][way]") {
  EscapeRoute ramp = bent();
  ramp.path[1].z = 0.5;
  CHECK_FALSE(is_level(ramp));
}

TEST_CASE("the core of an area excludes its border", "[emergency][way]") {
  AssessedArea area;
  // An L: 4 m by 4 m without its upper right quarter.
  area.outline = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  area.z_m = 1;
  const auto core = within(area, 0.5, 0.5);
  CHECK_FALSE(core.empty());
  for (const glm::dvec3& p : core) {
    CHECK(p.z == 1);
    CHECK(p.x >= 0.5);
    CHECK(p.y >= 0.5);
    CHECK(p.x <= 3.5);
    CHECK_FALSE((p.x > 1.5 && p.y > 1.5 && glm::length(glm::dvec2(p) - glm::dvec2(2, 2)) < 0.49));
    CHECK_FALSE((p.x > 2 && p.y > 2));
  }
  area.outline = {{0, 0}, {0.8, 0}, {0.8, 4}, {0, 4}};
  CHECK(within(area, 0.5, 0.5).empty());
}

TEST_CASE("if several storeys lie below a place, the nearest floor counts", "[emergency][way]") {
  SceneDescription scene;
  for (const double z : {3.0, 0.0, 6.0}) {
    EscapeRoute storey;
    storey.path = {{0, 0, z}, {10, 0, z}};
    storey.width_m = 2;
    scene.routes.push_back(storey);
  }
  CHECK(floor_below(scene, {5, 0.2, 2.5}) == 0.0);
  CHECK(floor_below(scene, {5, 0.2, 5.5}) == 3.0);
  CHECK(floor_below(scene, {5, 0.2, 8.5}) == 6.0);
}

TEST_CASE("walkers stand along the whole route and look along it", "[emergency][way]") {
  const auto people = walkers(bent(), 2);
  REQUIRE(people.size() == 4);
  CHECK(people[0].ahead == glm::dvec3(1, 0, 0));
  CHECK(people[2].foot == glm::dvec3(4, 0, 0));
  CHECK(people[2].ahead == glm::dvec3(0, 1, 0));
  CHECK(people[3].along_m == Approx(5.5));
}

TEST_CASE("the floor below a place is that of the nearest route or area", "[emergency][way]") {
  SceneDescription scene;
  CHECK_FALSE(floor_below(scene, {0, 0, 2}).has_value());
  scene.routes.push_back(bent());
  AssessedArea upper;
  upper.outline = {{10, 0}, {14, 0}, {14, 4}, {10, 4}};
  upper.z_m = 3;
  scene.open_areas.push_back(upper);
  CHECK(floor_below(scene, {3, 1, 2.5}) == 0.0);
  CHECK(floor_below(scene, {12, 1, 5.5}) == 3.0);
  CHECK(floor_below(scene, {12, 1, 2.5}) == 0.0);  // the area is above it
}
TEST_CASE("gaps of a grid lie between neighbouring points, and cover a route and a rectangle",
          "[emergency][way]") {
  EscapeRoute route;
  route.path = {{0, 0, 0}, {2, 0, 0}};
  route.width_m = 1;
  const auto line = [&](double aside_m) { return line_along(route, aside_m, 0.25); };
  const CalculationGrid centre = grid_of({line(0)}, false);
  CHECK(centre.places == along(route, 0, 0.25));
  REQUIRE(centre.gaps.size() == 8);
  CHECK(centre.gaps[3].from == centre.places[3]);
  CHECK(centre.gaps[3].corners == std::array<uint32_t, 4>{3, 4, 4, 4});
  const auto area_of = [](const CalculationGrid& grid) {
    double area = 0;
    for (const GridGap& gap : grid.gaps) area += glm::length(glm::cross(gap.along, gap.across));
    return area;
  };
  const CalculationGrid band = grid_within(0.5, 0.25, line);
  CHECK(band.places == within(route, 0.5, 0.25));
  CHECK(area_of(band) == Approx(2));
  AssessedArea area;
  area.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  const CalculationGrid hall = grid_of(area, 0.5, 0.5);
  CHECK(hall.places == within(area, 0.5, 0.5));
  CHECK(area_of(hall) == Approx(6));
}

TEST_CASE("no gap of a grid crosses a riser", "[emergency][way]") {
  const GridLeg level{{{0, 0, 0}, {1, 0, 0}}, {}};
  const GridLeg stairs{{{1.1, 0, 0.2}, {1.4, 0, 0.4}, {1.6, 0, 0.4}}, {1, 0, 1}};
  const CalculationGrid grid = grid_of({{level, stairs}}, true);
  REQUIRE(grid.places.size() == 5);
  REQUIRE(grid.gaps.size() == 2);
  CHECK(grid.gaps[0].corners == std::array<uint32_t, 4>{0, 1, 1, 1});
  CHECK(grid.gaps[1].corners == std::array<uint32_t, 4>{3, 4, 4, 4});
}
