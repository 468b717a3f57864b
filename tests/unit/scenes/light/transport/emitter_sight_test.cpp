// Cells of space learn which emitters light them: on either side of a wall, and in mirrors.
#include "scenes/light/transport/emitter_sight.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "scenes/light/transport/trace.hpp"
#include "tests/unit/scenes/light/transport/seen_scene.hpp"

using namespace luxodus;

namespace {

std::string room(const std::string& name, const std::string& low, const std::string& high) {
  return "[[object]]\nname = \"" + name + "\"\nshape = \"room\"\nlow = " + low +
         "\nhigh = " + high + "\nmaterial = \"grey50\"\n";
}

std::string point_lamp(const std::string& name, const std::string& position) {
  return "[[emitter]]\nname = \"" + name +
         "\"\nshape = \"point\"\ndistribution = \"isotropic\"\nposition = " + position +
         "\nflux_lm = 100\n";
}

/// A lamp that a screen hides from the floor: its light arrives only by a mirror on the wall x = 0,
/// in thin smoke.
const std::string mirror_room = R"(
[[material]]
name = "silver"
kind = "mirror"
specular = 0.81

[[object]]
name = "silvered wall"
shape = "box"
low = [0.005, 0.5, 0.5]
high = [0.01, 3.5, 2.5]
material = "silver"

[[object]]
name = "screen"
shape = "box"
low = [1.9, 1.5, 1.7]
high = [2.4, 2.5, 1.75]
material = "black5"

[[emitter]]
name = "lamp"
shape = "sphere"
diameter = 0.1
position = [2, 2, 1.9]
flux_lm = 1000

[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.1
albedo = 0.9
)" + room("room", "[0, 0, 0]", "[4, 4, 3]");

const Vec3 in_air(0), upward(0, 0, 1), east(1, 0, 0);

}  // namespace

TEST_CASE("the side of a cell is the axis nearest to the normal", "[transport]") {
  CHECK(cell_side(in_air) == 0);
  CHECK(cell_side(east) == 1);
  CHECK(cell_side(-east) == 2);
  CHECK(cell_side(Vec3(0.6f, -0.8f, 0)) == 4);
  CHECK(cell_side(upward) == 5);
  CHECK(cell_side(glm::normalize(Vec3(0.5f, 0.5f, -0.9f))) == 6);
  CHECK(cell_side(-upward) < cell_sides);
}

TEST_CASE("places of a side are on surfaces that face it, and some in the air", "[transport]") {
  test::SeenScene s(room("room", "[0, 0, 0]", "[4, 4, 3]") + point_lamp("a", "[1, 1, 2]") +
                    point_lamp("b", "[2, 1, 2]"));
  const CellGrid grid(*s.scene, limits::learned_cells);
  const size_t cell = grid.cell_of(s.at(2, 2, 0));
  Random random(1, RandomStream::test);
  random.start(0);
  size_t on_floor = 0;
  const auto places = sight_places(*s.scene, grid, cell, cell_side(upward), random, s.resolver);
  REQUIRE(places.size() == limits::sight_places);
  for (const SightPlace& place : places) {
    CHECK(grid.cell_of(place.at) == cell);
    if (place.normal == in_air) {
      CHECK(place.weight == limits::air_beside_surfaces);
      continue;
    }
    ++on_floor;
    CHECK(place.normal.z == Approx(1));
    CHECK(place.at.z == Approx(s.at(0, 0, 0).z).margin(1e-4));
    CHECK_FALSE(place.faces(-upward));
  }
  CHECK(on_floor == limits::surface_places);
  // No surface there faces east: all places are in the air, with equal weight.
  for (const SightPlace& place :
       sight_places(*s.scene, grid, cell, cell_side(east), random, s.resolver)) {
    CHECK(place.normal == in_air);
    CHECK(place.weight == 1);
  }
}

TEST_CASE("each side of a wall sees the lamps of its own room", "[transport]") {
  test::SeenScene s(room("west", "[0, 0, 0]", "[5.1, 5, 3]") +
                    room("east", "[5.2, 0, 0]", "[10, 5, 3]") +
                    point_lamp("west lamp", "[3, 2, 2]") + point_lamp("east lamp", "[7.1, 2, 2]"));
  constexpr uint32_t west_lamp = 0, east_lamp = 1;
  const CellGrid grid(*s.scene, limits::learned_cells);
  const Vec3 west_face = s.at(5.1, 2.6, 1.6), east_face = s.at(5.2, 2.6, 1.6);
  REQUIRE(grid.cell_of(west_face) == grid.cell_of(east_face));
  const CellSight& west = s.sight.at(west_face, -east, s.resolver);
  const CellSight& from_east = s.sight.at(east_face, east, s.resolver);
  CHECK(west.arriving_of(west_lamp) > 5 * west.arriving_of(east_lamp));
  CHECK(from_east.arriving_of(east_lamp) > 5 * from_east.arriving_of(west_lamp));
}

TEST_CASE("a lamp is known at its mirror image", "[transport]") {
  test::SeenScene s(mirror_room + point_lamp("far", "[3.9, 3.9, 2.9]"));
  const Vec3 below = s.at(1.5, 2, 0.001);
  const CellSight& seen = s.sight.at(below, upward, s.resolver);
  REQUIRE(seen.images.size() == 1);
  const Vec3 shown = s.at(-1.98, 2, 1.9);
  CHECK(glm::distance(seen.images[0].centre, shown) < 1e-3f);
  CHECK(seen.images[0].radius == Approx(0.05).epsilon(0.01));
  // An isotropic lamp sends 1 / (4 pi) per watt and steradian; smoke absorbs a third on the way.
  const double sent = power_seen(*s.scene, s.scene->emitters[0]) / (4 * 3.14159265) * 0.9;
  CHECK(seen.images[0].worth < sent);
  CHECK(seen.images[0].worth > 0.4 * sent);
  // Behind the mirror's plane there is no image.
  CHECK(s.sight.at(s.at(0.001, 0.2, 1), east, s.resolver).images.empty());
}

TEST_CASE("mirrors are not searched for if no direction is guided", "[transport]") {
  std::string clear = mirror_room;
  clear.erase(clear.find("[[medium]]"),
              clear.find("[[object]]\nname = \"room\"") - clear.find("[[medium]]"));
  test::SeenScene s(clear + point_lamp("far", "[3.9, 3.9, 2.9]"));
  CHECK(s.sight.at(s.at(1.5, 2, 0.001), upward, s.resolver).images.empty());
}

TEST_CASE("glow is visible where an emitter sends no direct light", "[transport]") {
  const std::string lit = R"(
[[emitter]]
name = "downlight"
shape = "disc"
diameter = 0.1
distribution = "cosine_power"
cosine_power = 40
position = [2, 2, 2.99]
flux_lm = 100

[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 1
albedo = 0.9
)" + room("room", "[0, 0, 0]", "[4, 4, 3]");
  test::SeenScene s(lit + point_lamp("weak", "[0.1, 0.1, 0.1]"));
  // High on the wall, level with the smoke below the downlight.
  const CellSight& seen = s.sight.at(s.at(3.999, 2, 2.6), -east, s.resolver);
  const auto downlight = std::find_if(seen.bright.begin(), seen.bright.end(),
                                      [](const CellSight::Bright& b) { return b.emitter == 0; });
  REQUIRE(downlight != seen.bright.end());
  CHECK(downlight->glowing > 5 * downlight->arriving);
  CHECK(downlight->glowing < limits::glow_arriving);
}

TEST_CASE("paths guided to a lamp in a mirror find equal light with less noise", "[transport]") {
  test::SeenScene s(mirror_room + point_lamp("far", "[3.9, 3.9, 2.9]"));
  struct Spread {
    double mean = 0, error = 0;
  };
  const auto trace = [&](const std::shared_ptr<const EmitterSight>& sight) {
    const auto tracer = make_picture_tracer(*s.scene, GeometryAccess::resident(s.index), 7, sight);
    constexpr uint32_t paths = 60'000;
    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < paths; ++i) {
      tracer->start(uint64_t{i} << 20, 1, 0);
      const Ray ray{s.at(3, 0.5, 0.5), glm::normalize(s.at(1.5, 2, 0) - s.at(3, 0.5, 0.5))};
      const double light = tracer->radiance_in_band(ray, 0, nullptr);
      sum += light;
      squares += light * light;
    }
    const double mean = sum / paths;
    return Spread{mean, std::sqrt((squares / paths - mean * mean) / paths)};
  };
  const Spread by_chance = trace(nullptr), aimed = trace(make_emitter_sight(*s.scene));
  CHECK(std::abs(aimed.mean - by_chance.mean) < 4 * std::hypot(aimed.error, by_chance.error));
  CHECK(aimed.error < 0.5 * by_chance.error);
}
