// People through walls: their transform is wrong.
#include "actors/judge/walk/wall_check.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/actors/judge/walk/walk_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

Result<WallCheck> checked(const std::vector<PlacedPerson>& people) {
  const auto scene = described_text(hall_text);
  return check_walls(*scene, scene->scenarios.front(), people, 1);
}

}  // namespace

TEST_CASE("people walk through doors and not through walls", "[walk]") {
  const auto through_door = checked({walker_from({1, 3, 0}, {19, 3, 0}, 18)});
  REQUIRE(through_door.ok());
  CHECK(through_door->steps == 36);
  CHECK(through_door->wrong == 0);
  const auto through_wall = checked({walker_from({1, 1, 0}, {19, 1, 0}, 18)});
  REQUIRE_FALSE(through_wall.ok());
  CHECK_THAT(through_wall.problem().text(),
             Catch::Contains("of 36 steps of the people cross walls"));
  CHECK_THAT(through_wall.problem().text(), Catch::Contains("person 1 of \"people\" at 8.5 s"));
}

TEST_CASE("a few steps through walls are counted, not refused", "[walk]") {
  std::vector<PlacedPerson> people(10, walker_from({1, 3, 0}, {9, 3, 0}, 100));
  people.push_back(walker_from({9, 1, 0}, {11, 1, 0}, 2));
  const auto check = checked(people);
  REQUIRE(check.ok());
  CHECK(check->steps == 2004);
  CHECK(check->wrong == 2);  // one across each side, or from within
}

TEST_CASE("people outside of the building are one error", "[walk]") {
  const auto outside = checked({walker_from({1, 3, 0}, {25, 3, 0}, 24)});
  REQUIRE_FALSE(outside.ok());
  CHECK_THAT(
      outside.problem().text(),
      Catch::Contains("person 1 of \"people\" is outside of the building at 24 s, at (25, 3, "
                      "0) m"));
  CHECK_FALSE(checked({walker_from({1, 3, -4}, {2, 3, -4}, 1)}).ok());
}
