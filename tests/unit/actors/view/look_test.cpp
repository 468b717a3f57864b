// What the page is told of faces of lamps and of gloss.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "actors/view/gloss.hpp"
#include "actors/view/lamps.hpp"
#include "tests/unit/actors/view/live_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr double pi = std::numbers::pi;

double luminance(const std::array<double, 3>& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// Of a lamp, so many degrees from the axis of its table, at one azimuth [cd/m2].
double luminance_at(const LiveLamps& lamps, size_t lamp, double polar_deg, size_t azimuth = 0) {
  const LampTable& table = lamps.tables.at(lamps.lamps.at(lamp).table);
  const auto row = static_cast<size_t>(polar_deg * limits::lamp_polar / 180);
  const size_t at = 2 * (row * limits::lamp_azimuth + azimuth);
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(table.values.at(i)); };
  return luminance(lamps.lamps[lamp].colour) * table.peak * (byte(at) + 256 * byte(at + 1)) / 65535;
}

std::string lamp(const std::string& name, const std::string& shape,
                 const std::string& distribution) {
  return "\n[[emitter]]\nname = \"" + name + "\"\nposition = [1, 1, 2.5]\nflux_lm = 600\n" + shape +
         "\ndistribution = \"" + distribution + "\"\n";
}

const std::string square = "shape = \"rectangle\"\nsize = [0.5, 0.4]";

}  // namespace

TEST_CASE("a lamp with a face is told, a point and a sign are not", "[view]") {
  const LiveRoom room(lamp("panel", square, "lambertian"));
  const auto scene = room.compiled({});
  const LiveLamps lamps = lamps_of(*scene);
  REQUIRE(lamps.lamps.size() == 1);
  const LiveLamp& panel = lamps.lamps.front();
  CHECK(panel.kind == EmitterKind::rectangle);
  CHECK(glm::length(panel.origin - glm::dvec3(1, 1, 2.5)) < 1e-6);
  CHECK(glm::length(panel.axes[2] - glm::dvec3(0, 0, 1)) < 1e-6);
  CHECK(scene->groups.size() == 4);
  CHECK(panel.group != scene->groups[0].name);
}

TEST_CASE("a Lambertian face has its exitance by pi from below, and nothing from above", "[view]") {
  const LiveRoom room(lamp("panel", square, "lambertian"));
  const LiveLamps lamps = lamps_of(*room.compiled({}));
  const double expected = 600 / (0.5 * 0.4) / pi;
  for (const double polar : {1.0, 30.0, 60.0, 80.0})
    CHECK(luminance_at(lamps, 0, polar) == Approx(expected).epsilon(1e-3));
  for (const double polar : {100.0, 150.0}) CHECK(luminance_at(lamps, 0, polar) == 0);
}

TEST_CASE("lamps of one distribution share a table", "[view]") {
  const LiveRoom room(lamp("panel", square, "lambertian") + lamp("second", square, "lambertian") +
                      lamp("glow", square, "isotropic"));
  const LiveLamps lamps = lamps_of(*room.compiled({}));
  REQUIRE(lamps.lamps.size() == 3);
  CHECK(lamps.tables.size() == 2);
  CHECK(lamps.lamps[0].table == lamps.lamps[1].table);
  // Both sides of it shine: 600 lm over the sphere, by the area that is seen.
  const double at = 43.75 / 180 * pi;  // the middle of a cell
  const double expected = 600 / (4 * pi) / (0.5 * 0.4 * std::cos(at));
  CHECK(luminance_at(lamps, 2, 43.75) == Approx(expected).epsilon(1e-3));
  CHECK(luminance_at(lamps, 2, 180 - 43.75) == Approx(expected).epsilon(1e-3));
}

TEST_CASE("gloss is told of glossy sides and of mirrors, with what is not in the lobe", "[view]") {
  const LiveRoom room(R"(
[[material]]
name = "lacquer"
kind = "glossy"
reflectance = 0.3
specular = 0.1
roughness = 0.15

[[material]]
name = "silver"
kind = "mirror"
specular = 0.9

[[object]]
name = "table"
shape = "quad"
corner = [1, 1, 0.7]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "lacquer"
back_material = "grey50"

[[object]]
name = "glass"
shape = "quad"
corner = [4, 1, 0.7]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "grey50"
back_material = "silver"
)");
  const auto scene = room.compiled({});
  const auto gloss = gloss_of(*scene);
  REQUIRE(gloss.size() == 2);
  CHECK(scene->surfaces[gloss[0].surface].name == "table");
  CHECK_FALSE(gloss[0].back);
  for (const double share : gloss[0].mirrored) CHECK(share == Approx(0.1).epsilon(1e-3));
  CHECK(gloss[0].spread == Approx(0.75).epsilon(1e-3));
  CHECK(gloss[0].roughness == Approx(0.15));
  CHECK(scene->surfaces[gloss[1].surface].name == "glass");
  CHECK(gloss[1].back);
  CHECK(gloss[1].spread == 0);
  CHECK(gloss[1].roughness == 0);
}
