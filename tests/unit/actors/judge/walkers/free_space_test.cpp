// Where a body can stand: clear of walls and furniture, on a floor, through doors.
#include "actors/judge/walkers/free_space.hpp"

#include "tests/unit/actors/judge/walkers/walkers_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("a body anywhere in a free cell is clear of all walls", "[walkers]") {
  const double cell_m = GENERATE(0.1, 0.07);
  const Floor floor(room_text(4, 3) + box_text("pillar", {2, 1, 0}, {2.4, 1.6, 3}), cell_m);
  const FreeSpace& space = *floor.space;
  const auto distance = [](const glm::dvec2& p) {
    const glm::dvec2 to_wall = glm::min(p, glm::dvec2(4, 3) - p);
    const glm::dvec2 beside = glm::max(glm::dvec2(2, 1) - p, p - glm::dvec2(2.4, 1.6));
    return std::min({to_wall.x, to_wall.y, glm::length(glm::max(beside, glm::dvec2(0)))});
  };
  size_t free = 0;
  for (CellNumber cell = 0; cell < space.cells(); ++cell) {
    const glm::dvec2 c = space.centre(cell);
    const double clear_m = body_radius_m + cell_m * std::sqrt(0.5);
    INFO(c.x << ", " << c.y);
    if (std::abs(distance(c) - clear_m) > 1e-6)
      CHECK(space.is_free(cell) == (distance(c) > clear_m));
    free += space.is_free(cell) ? 1 : 0;
  }
  CHECK(free > 100);
}

TEST_CASE("what is overhead, underfoot or a door is not in the way, and furniture is",
          "[walkers]") {
  const auto stands_at_2 = [](const std::string& thing) {
    const Floor floor(room_text(4, 3) + thing);
    return floor.space->nearest_free({2, 1.5}, 0.1).has_value();
  };
  CHECK(stands_at_2(""));
  CHECK(stands_at_2(box_text("beam", {1.5, 0, 2}, {2.5, 3, 2.3})));
  CHECK(stands_at_2(box_text("threshold", {1.5, 0, 0}, {2.5, 3, 0.2})));
  CHECK_FALSE(stands_at_2(box_text("kerb", {1.5, 0, 0}, {2.5, 3, 0.3})));
  CHECK_FALSE(
      stands_at_2(box_text("table", {1.5, 1, 0.7}, {2.5, 2, 0.75}, "tags = [\"furniture\"]\n")));
  const std::string leaf =
      "\n[[object]]\nname = \"leaf\"\nshape = \"quad\"\ncorner = [2, 0, 0]\nedge_u = [0, 3, 0]\n"
      "edge_v = [0, 0, 2.1]\nmaterial = \"grey50\"\n";
  CHECK_FALSE(stands_at_2(leaf));
  CHECK(stands_at_2(leaf + "door = { hinge = [2, 0, 0], open_angle_deg = 90 }\n"));
}

TEST_CASE("where there is no floor nobody stands", "[walkers]") {
  const std::string slab =
      "\n[[object]]\nname = \"slab\"\nshape = \"quad\"\ncorner = [0, 0, {z}]\nedge_u = [4, 0, 0]\n"
      "edge_v = [0, 3, 0]\nmaterial = \"grey50\"\n";
  const auto at = [&](const char* z) {
    std::string text = slab;
    return text.replace(text.find("{z}"), 3, z);
  };
  const std::string mast = box_text("mast", {7.9, 2.9, 0}, {8, 3, 3});
  const Floor floor(at("0") + mast);
  CHECK(floor.space->nearest_free({2, 1.5}, 0.1));
  CHECK_FALSE(floor.space->nearest_free({6, 1.5}, 0.5));
  CHECK_FALSE(Floor(at("-0.3") + mast).space->nearest_free({2, 1.5}, 0.1));
  CHECK(Floor(at("4") + mast, 0.1, 4).space->nearest_free({2, 1.5}, 0.1));
}

TEST_CASE("a line of sight over the floor touches free cells only", "[walkers]") {
  const Floor floor(room_text(6, 4) + box_text("wall", {2.9, 0, 0}, {3.1, 2, 3}));
  const FreeSpace& space = *floor.space;
  const auto sees = [&](double x0, double y0, double x1, double y1) {
    const bool out = space.sees(floor.cell(x0, y0), floor.cell(x1, y1));
    CHECK(out == space.sees(floor.cell(x1, y1), floor.cell(x0, y0)));
    return out;
  };
  CHECK(sees(1, 3, 5, 3));
  CHECK(sees(1, 1, 2.3, 1));
  CHECK_FALSE(sees(1, 1, 5, 1));
  CHECK_FALSE(sees(1, 1, 5, 2.9));  // past the corner by less than a body
  CHECK(sees(1, 1, 1, 1));
}

TEST_CASE("a floor of too many cells is refused before they are made", "[walkers]") {
  const auto scene = described_text(room_text(900, 900) + mains_text);
  const auto walls = walls_alone(*scene, scene->scenarios.front(), 1);
  REQUIRE(walls.ok());
  const auto space = FreeSpace::make(*walls.value(), {.cell_m = 0.1});
  REQUIRE_FALSE(space.ok());
  CHECK_THAT(space.problem().text(),
             Catch::Contains("8.1e+07 cells of 0.1 m") && Catch::Contains("give a larger --cell"));
}

TEST_CASE("nobody stands within a thick wall", "[walkers]") {
  const Floor floor(room_text(20, 6) + box_text("block", {14, 2, 0}, {18, 5, 3}));
  CHECK_FALSE(floor.space->nearest_free({16, 3.5}, 0.9));
  CHECK(floor.space->nearest_free({13, 3.5}, 0.1));
}
