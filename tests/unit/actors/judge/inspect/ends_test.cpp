// The inspection ends, and says what is wrong, in scenes that are far from any building: rooms that
// absorb nothing, ways of thousands of kilometres, many things in one place.
#include "actors/judge/inspect/ways_size.hpp"
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

const std::string bulb =
    "[[emitter]]\nname = \"bulb\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
    "position = [6, 0, 2.5]\nflux_lm = 1000\n";

/// The closed room in one material, with a lamp.
std::vector<Finding> room_of(const std::string& material) {
  return found_in("[[material]]\nname = \"own\"\n" + material + "\n" +
                  replaced(closed_room, "\"grey50\"", "\"own\"") + bulb);
}

}  // namespace

TEST_CASE("a closed room that absorbs nothing is an error, one that hardly does a warning",
          "[inspect][ends]") {
  const std::string never = "illuminances have no limit";
  check_found(room_of("reflectance = 1.0"), Severity::error, never);
  check_found(room_of("kind = \"mirror\"\nspecular = 1.0"), Severity::error, never);
  check_found(room_of("reflectance = 0.99999"), Severity::warning, "light is hardly absorbed");
  CHECK(that_say(room_of("reflectance = 0.95"), "absorbed").empty());
  const std::string smoke =
      "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = 1\nalbedo = 0.5\n";
  check_found(room_of("reflectance = 1.0\n" + smoke), Severity::warning,
              "nothing but smoke ends a particle");
}

TEST_CASE("a white room with a hole lets its light out", "[inspect][ends]") {
  const auto open = found_in(
      "[[material]]\nname = \"own\"\nreflectance = 1.0\n[[object]]\nname = \"floor\"\n"
      "shape = \"quad\"\ncorner = [0, -2, 0]\nedge_u = [12, 0, 0]\nedge_v = [0, 4, 0]\n"
      "material = \"own\"\n" +
      bulb);
  CHECK(that_say(open, "absorbed").empty());
  CHECK(that_say(open, "the rooms are not closed").size() == 1);
}

TEST_CASE("ways of thousands of kilometres are errors with their size, and have no floor",
          "[inspect][ends]") {
  const auto route = found_in(furnished_room +
                              "[[route]]\nname = \"way\"\npath = [[1, 0, 0], [1e7, 0, 0]]\n"
                              "width = 1\n");
  check_found(route, Severity::error, "route \"way\" is 1e+04 km long");
  check_found(route, Severity::error, "has no floor under it");
  const auto area = found_in(furnished_room +
                             "[[open_area]]\nname = \"hall\"\n"
                             "outline = [[0, 0], [12000, 0], [12000, 2400], [0, 2400]]\n");
  check_found(area, Severity::error, "has no floor under most of it");
  check_found(area, Severity::error, "open area \"hall\" is 12 km by 2.4 km");
  const auto large = found_in(furnished_room +
                              "[[open_area]]\nname = \"hall\"\n"
                              "outline = [[0, 0], [3000, 0], [3000, 1500], [0, 1500]]\n");
  check_found(large, Severity::error, "has no floor under most of it");
  CHECK(that_say(large, "points of calculation").empty());
}

TEST_CASE("many luminaires and signs in one place are told once each", "[inspect][ends]") {
  std::string text = closed_room;
  constexpr int count = 3000;
  for (int i = 0; i < count; ++i)
    text += replaced(lamp, "name = \"lamp\"", "name = \"lamp " + std::to_string(i) + "\"");
  const auto lamps = found_in(text);
  const auto same = that_say(lamps, "stands where emitter \"lamp 0\"");
  REQUIRE(same.size() == limits::findings_of_a_kind);
  CHECK(same.back().problem.what.find("(and " + std::to_string(count - 11) + " more like this)") !=
        std::string::npos);
}

TEST_CASE("places of large ways are some of them, and those of usual ways are all",
          "[inspect][ends]") {
  AssessedArea area;
  area.outline = {{0, 0}, {20, 0}, {20, 10}, {0, 10}};
  CHECK(places_within(area, 0.5, 0.5) == within(area, 0.5, 0.5));
  area.outline = {{0, 0}, {1e6, 0}, {1e6, 1}, {0, 1}};
  CHECK(places_within(area, 0.1, 0.5).size() < 3 * limits::inspected_places);
  area.outline = {{0, 0}, {1e6, 0}, {1e6, 1e6}, {0, 1e6}};
  CHECK(places_within(area, 0.1, 0.5).size() < 2 * limits::inspected_places);
  EscapeRoute route;
  route.width_m = 2;
  route.path = {{0, 0, 0}, {30, 0, 0}};
  CHECK(places_along(route, 1) == along(route, 0, 1));
  CHECK(places_within(route, 0.5, 0.5) == within(route, 0.5, 0.5));
  CHECK(steps_along(route, 0.25).size() == walkers(route, 0.25).size());
  route.path = {{0, 0, 0}, {1e7, 0, 0}};
  CHECK(places_along(route, 1).size() < 2 * limits::inspected_places);
  CHECK(places_within(route, 0.5, 0.5).size() < 4 * limits::inspected_places);
  CHECK(steps_along(route, 0.25).size() < 2 * limits::inspected_steps);
}
