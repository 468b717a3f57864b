#include "scenes/emergency/spacing.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes/formats/photometry/photometric_file.hpp"

using namespace luxodus;

namespace {

/// The file's factors in the scenes of the library: maintenance 0.8, end of duration 0.7.
constexpr double end_of_life = 0.56;

Intensity corridor_light() {
  const auto file = read_photometric_file(std::filesystem::path(LUX_SOURCE_DIR) /
                                          "scenes/library/luminaires/emergency_corridor.ldt");
  REQUIRE(file);
  return [web = file->web](const glm::dvec3& d) { return web->intensity(d); };
}

/// A source whose illuminance on the plane below it has a closed form.
Intensity isotropic(double candela) {
  return [candela](const glm::dvec3&) { return candela; };
}

double angle_deg(const glm::dvec3& direction) {
  return std::acos(std::clamp(-direction.z, -1.0, 1.0)) * 180 / std::numbers::pi;
}

std::vector<SpacingRow> rows(const Intensity& light, std::vector<double> heights, double level,
                             double factor = 1) {
  return spacing_table(light, {std::move(heights), {level}, {factor}, 0.02});
}

}  // namespace

TEST_CASE("the corridor light of the library has the spacing of the arithmetic",
          "[emergency][spacing]") {
  const auto table = rows(corridor_light(), {2.5, 2.8, 3.5}, 1, end_of_life);
  REQUIRE(table.size() == 3);
  const double along[3][2] = {{6.15, 12.97}, {6.74, 14.32}, {7.81, 17.29}};
  for (size_t i = 0; i < 3; ++i) {
    INFO(table[i].height_m);
    REQUIRE(table[i].along);
    CHECK(table[i].along->to_wall_m == Approx(along[i][0]).margin(0.005));
    CHECK(table[i].along->between_m == Approx(along[i][1]).margin(0.005));
  }
  REQUIRE(table[1].across);
  CHECK(table[1].across->to_wall_m == Approx(1.73).margin(0.005));
  CHECK(table[1].across->between_m == Approx(3.94).margin(0.005));
}

TEST_CASE("at the distances of a spacing table the illuminance is the level",
          "[emergency][spacing]") {
  const Intensity light = corridor_light();
  for (const double height : {2.3, 3.0, 6.0})
    for (const double level : {0.5, 1.0, 5.0})
      for (const double c : {0.0, 90.0}) {
        const auto table = spacing_table(light, {{height}, {level}, {end_of_life}, 0.02});
        const auto& spacing = c == 0 ? table[0].along : table[0].across;
        INFO(height << " m, " << level << " lx, C" << c);
        const auto lux = [&](double x) {
          return end_of_life * illuminance_beside(light, c, height - 0.02, std::abs(x));
        };
        if (lux(0) < level) {
          CHECK_FALSE(spacing);
          continue;
        }
        REQUIRE(spacing);
        CHECK(lux(spacing->to_wall_m) == Approx(level).epsilon(1e-4));
        // The darkest point between the two, looked for on a grid of its own.
        double least = 1e9;
        for (int i = 0; i <= 1000; ++i) {
          const double x = spacing->between_m * i / 1000;
          least = std::min(least, lux(x) + lux(spacing->between_m - x));
        }
        CHECK(least == Approx(level).epsilon(2e-4));
      }
}

TEST_CASE("a point source that shines equally has the spacing of its closed form",
          "[emergency][spacing]") {
  // E = I h / (h^2 + x^2)^1.5, so x^2 = (I h / E)^(2/3) - h^2; two of them give twice that at their
  // middle, which is the darkest point between them at these distances.
  const double h = 2.98, candela = 100;
  const auto reach = [&](double level) {
    return std::sqrt(std::pow(candela * h / level, 2.0 / 3) - h * h);
  };
  for (const double level : {0.5, 1.0, 2.0}) {
    const auto table = rows(isotropic(candela), {3}, level);
    REQUIRE(table[0].along);
    CHECK(table[0].along->to_wall_m == Approx(reach(level)).epsilon(1e-5));
    CHECK(table[0].along->between_m == Approx(2 * reach(level / 2)).epsilon(1e-5));
    CHECK(table[0].across->between_m == Approx(table[0].along->between_m));
  }
}

TEST_CASE("a dark ring ends both distances, although it is bright beyond", "[emergency][spacing]") {
  // Dark from 40 to 43 degrees: the second luminaire is too far to light that ring.
  const Intensity ring = [](const glm::dvec3& d) {
    const double gamma = angle_deg(d);
    return gamma > 40 && gamma < 43 ? 0 : 2000 * std::pow(std::max(0.0, -d.z), -2.0);
  };
  const auto table = rows(ring, {3}, 30);
  REQUIRE(table[0].along);
  const double edge = 2.98 * std::tan(40 * std::numbers::pi / 180);
  CHECK(table[0].along->to_wall_m == Approx(edge).epsilon(0.005));
  CHECK(table[0].along->between_m < 3 * edge);
}

TEST_CASE("the weaker side of a luminaire counts towards the wall", "[emergency][spacing]") {
  const Intensity lopsided = [](const glm::dvec3& d) { return d.x > 0 ? 300.0 : 100.0; };
  const auto table = rows(lopsided, {3}, 1);
  const auto weak = rows(isotropic(100), {3}, 1), strong = rows(isotropic(300), {3}, 1);
  CHECK(table[0].along->to_wall_m == Approx(weak[0].along->to_wall_m));
  CHECK(table[0].along->between_m > weak[0].along->between_m);
  CHECK(table[0].along->between_m < strong[0].along->between_m);
}

TEST_CASE("a level that is not met below the luminaire has no spacing", "[emergency][spacing]") {
  const auto table = rows(isotropic(1), {3}, 1);
  CHECK_FALSE(table[0].along);
  CHECK_FALSE(table[0].across);
}
