// Tests direct light on flights of stairs: which flights there are, and that a layout lights them.
#include "actors/judge/design/stair_flights.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/assess/code_light.hpp"
#include "actors/judge/design/record_design.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;

/// Ten steps of 0.17 m by 0.28 m from (x, y, 0), 1.2 m wide.
std::string stairs(double x, double y, const char* more = "") {
  return fmt::format(
      "[[object]]\nname = \"stairs\"\nshape = \"stairs\"\nmaterial = \"grey50\"\nsteps = 10\n"
      "rise = 0.17\ngoing = 0.28\nwidth = 1.2\ntranslate = [{}, {}, 0]\n{}\n",
      x, y, more);
}

/// A route along a room, and stairs behind a wall, where no rule for the route requires light.
std::string behind_a_wall(const std::string& behind, const std::string& settings) {
  return test::box_room(10, 5, 4) + test::judged_2013 + test::way_along(1, 9, 1, 0.8) +
         "[[object]]\nname = \"wall\"\nshape = \"box\"\nlow = [0, 2.4, 0]\nhigh = [10, 2.6, "
         "4]\nmaterial = \"white50\"\n" +
         behind + "[design]\nplace_signs = false\nfailure = \"none\"\n" + settings;
}

std::vector<StairFlight> flights_in(const TemporaryFolder& folder, const std::string& text) {
  const auto scene = test::described(folder.write("flights.toml", text));
  return flights_beside_routes(*scene, *scene->design);
}

/// Flights of the first route.
std::vector<FlightOfRoute> flights_on(const TemporaryFolder& folder, const std::string& text) {
  const auto scene = test::described(folder.write("flights.toml", text));
  const auto building = Building::make(code_scene(*scene, false), code_scenario(*scene, {}), 1);
  REQUIRE(building.ok());
  return RouteFloor(*building.value()).flights_of(scene->routes.front());
}

size_t behind(const DesignResult& result) {
  return static_cast<size_t>(
      std::count_if(result.luminaires.begin(), result.luminaires.end(),
                    [](const PlacedLuminaire& o) { return o.candidate.position.y > 2.6; }));
}

}  // namespace

TEST_CASE("flights are stairs of objects, copies included, and legs of routes that climb",
          "[design][flights]") {
  const TemporaryFolder folder;
  const std::string room = test::box_room(20, 5, 8) + test::judged_2013 + test::spot_of_45_deg;
  const auto own =
      flights_in(folder, room + test::way_along(1, 9, 1) +
                             stairs(3, 2, "repeat = [{ count = 2, step = [6, 0, 0] }]"));
  REQUIRE(own.size() == 2);
  CHECK(own[0].treads == 10);
  const auto treads = treads_of(own[0]);
  REQUIRE(treads.size() == 10);
  for (int i = 0; i < 10; ++i)
    CHECK(glm::length(treads[static_cast<size_t>(i)] -
                      glm::dvec3(3 + 0.28 * (i + 0.5), 2.6, 0.17 * (i + 1))) < 1e-9);
  CHECK(own[1].lowest.x == Approx(own[0].lowest.x + 6));
  // A leg that descends by 30 degrees is a flight, whose treads follow from its rise where none are
  // drawn; a ramp of 1 in 12 is none.
  const auto of_route = flights_on(
      folder, room + test::route("down", "[1, 1, 3], [4, 1, 3], [9.2, 1, 0], [15, 1, 0]"));
  REQUIRE(of_route.size() == 1);
  CHECK(of_route[0].name == "down, flight 1");
  REQUIRE(of_route[0].treads.size() == 18);
  CHECK(of_route[0].treads.front().x == Approx(9.2));
  CHECK(flights_on(folder, room + test::route("ramp", "[1, 4, 0.5], [7, 4, 0]")).empty());
  // A flight that a route climbs is the route's, on the treads of the object.
  const std::string climbed =
      room + stairs(3, 0.4) + test::route("up", "[1, 1, 0], [3, 1, 0], [5.8, 1, 1.7]");
  CHECK(flights_in(folder, climbed).empty());
  const auto flights = flights_on(folder, climbed);
  REQUIRE(flights.size() == 1);
  REQUIRE(flights[0].treads.size() == 10);
  for (int i = 0; i < 10; ++i)
    CHECK(glm::length(flights[0].treads[static_cast<size_t>(i)] -
                      glm::dvec3(3 + 0.28 * (i + 0.5), 1, 0.17 * (i + 1))) < 0.01);
}

TEST_CASE("each flight has a luminaire that lights all of it, which no rule for routes requires",
          "[design][flights]") {
  const TemporaryFolder folder;
  const std::string places =
      "places = [[2, 1, 3.97], [4, 1, 3.97], [6, 1, 3.97], [8, 1, 3.97], [1, 3.8, 3.97], "
      "[5, 3.8, 3.97]]\n";
  const auto without = test::designed(folder.write("without.toml", behind_a_wall("", places)));
  CHECK(behind(without) == 0);
  const auto file = folder.write("scene.toml", behind_a_wall(stairs(3.6, 3.2), places));
  const auto with = test::designed(file);
  CHECK(with.answer.objective == Approx(without.answer.objective + 1));
  CHECK(behind(with) == 1);
  const auto group =
      std::find_if(with.groups.begin(), with.groups.end(),
                   [](const ConstraintGroup& g) { return g.kind == DemandKind::stairs; });
  REQUIRE(group != with.groups.end());
  CHECK(demand_words(*group).find("flight of stairs \"stairs\"") != std::string::npos);
  CHECK(with.tightest[static_cast<size_t>(group - with.groups.begin())] >= 1);
  CHECK(test::failing_on_disk(folder, file, with).empty());
}

TEST_CASE("a flight that no candidate lights is reported, and no light is required there",
          "[design][flights]") {
  const TemporaryFolder folder;
  const std::string places = "places = [[2, 1, 3.97], [5, 1, 3.97], [8, 1, 3.97]]\n";
  const auto file = folder.write("scene.toml", behind_a_wall(stairs(3.6, 3.2), places));
  const auto result = test::designed(file);
  REQUIRE_FALSE(result.luminaires.empty());
  CHECK(result.unlit_stair_flights == std::vector<std::string>{"stairs"});
  CHECK(std::none_of(result.groups.begin(), result.groups.end(),
                     [](const ConstraintGroup& g) { return g.kind == DemandKind::stairs; }));
  CHECK(record_of(*test::described(file), result, "1").unlit_flights.size() == 1);
}

TEST_CASE("a luminaire that must not stay at its place lights no flight", "[design][flights]") {
  const TemporaryFolder folder;
  // At 1.9 m it hangs too low (E14).
  const std::string low = R"(
[[emitter]]
name = "low"
shape = "disc"
diameter = 0.1
position = [5, 4.6, 1.9]
flux_lm = 300
emergency = "non-maintained"
emergency_flux = 300
maintenance_factor = 0.8
end_of_duration_factor = 0.7
)";
  const auto result = test::designed(folder.write(
      "scene.toml", behind_a_wall(low + stairs(3.6, 2.8),
                                  "existing = \"movable\"\nplaces = [[2, 1, 3.97], [5, 1, 3.97], "
                                  "[8, 1, 3.97]]\n")));
  CHECK(result.unlit_stair_flights == std::vector<std::string>{"stairs"});
  CHECK(behind(result) == 0);
}

}  // namespace luxodus
