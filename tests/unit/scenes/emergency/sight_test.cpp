#include "scenes/emergency/sight.hpp"

#include <catch2/catch.hpp>

#include "scenes/emergency/smoke_laws.hpp"
#include "scenes/emergency/veil.hpp"

using namespace luxodus;

namespace {

/// Its age factor is nearly 1; tests divide by it.
const Eye young{23, 2};

double threshold(double background, double size) {
  return luminance_threshold(background, size, false, young) / age_factor(23);
}

}  // namespace

TEST_CASE("thresholds agree with Adrian's law", "[emergency][sight]") {
  // Computed from the published formulas to three digits: background, then thresholds at 4, 7, 9,
  // 20'.
  const double rows[4][5] = {{0.01, 0.0328, 0.0126, 0.0084, 0.0028},
                             {0.1, 0.0551, 0.0233, 0.0164, 0.0066},
                             {1, 0.172, 0.0773, 0.0564, 0.0255},
                             {10, 0.733, 0.371, 0.288, 0.156}};
  const double sizes[4] = {4, 7, 9, 20};
  for (const auto& row : rows)
    for (int i = 0; i < 4; ++i) {
      INFO(row[0] << " cd/m2, " << sizes[i] << " arcmin");
      CHECK(threshold(row[0], sizes[i]) == Approx(row[i + 1]).epsilon(0.02));
    }
}

TEST_CASE("size, time, age and background change the threshold, which is above zero in the dark",
          "[emergency][sight]") {
  CHECK(threshold(1, 2) > threshold(1, 4));
  CHECK(threshold(10, 4) > threshold(1, 4));
  CHECK(luminance_threshold(1, 4, false, {70, 2}) > luminance_threshold(1, 4, false, {40, 2}));
  CHECK(luminance_threshold(1, 4, false, {40, 0.2}) > luminance_threshold(1, 4, false, {40, 2}));
  CHECK(luminance_threshold(1, 4, true, young) < luminance_threshold(1, 4, false, young));
  CHECK(threshold(0, 4) > 0);
  CHECK(threshold(0, 4) == threshold(1e-7, 4));
}

TEST_CASE("the age factor is continuous at 64 years and is one for young eyes",
          "[emergency][sight]") {
  CHECK(age_factor(23) == Approx(1).epsilon(0.005));
  CHECK(age_factor(64) == Approx(1.927).epsilon(0.001));
  CHECK(age_factor(64.001) == Approx(age_factor(64)).epsilon(0.02));
  CHECK(age_factor(75) == Approx(4.34).epsilon(0.01));
}

TEST_CASE("the visibility level is the luminance difference divided by the threshold",
          "[emergency][sight]") {
  const double seen = luminance_threshold(1, 4, false, young);
  CHECK(visibility_level(1 + seen, 1, 4, young) == Approx(1));
  CHECK(visibility_level(1 + 7 * seen, 1, 4, young) == Approx(7));
  const double darker = luminance_threshold(1, 4, true, young);
  CHECK(visibility_level(1 - darker, 1, 4, young) == Approx(1));
}

TEST_CASE("the veiling luminance falls with the angle and grows with age", "[emergency][sight]") {
  // 10/1000 + (5/100 + 0.05/10)(1 + (25/62.5)^4) + 0.00125.
  CHECK(veil_per_lux(10, 25) == Approx(0.01 + 0.055 * 1.0256 + 0.00125));
  CHECK(veil_per_lux(1, 65) > veil_per_lux(1, 25));
  CHECK(veil_per_lux(1, 65) > 10 * veil_per_lux(10, 65));
  CHECK(veil_per_lux(0, 65) == veil_per_lux(0.1, 65));
  CHECK(veil_per_lux(170, 65) == veil_per_lux(100, 65));
}

TEST_CASE("Jin's law and that of irritant smoke agree at 0.25/m", "[emergency][smoke]") {
  CHECK(jin_constant(SignLighting::internal) == 8);
  CHECK(jin_constant(SignLighting::external) == 3);
  CHECK(jin_distance_m(8, 0.5) == 16);
  CHECK(std::isinf(jin_distance_m(8, 0)));
  CHECK(irritant_distance_m(8, 0.2) == jin_distance_m(8, 0.2));
  CHECK(irritant_distance_m(8, 0.25) == Approx(jin_distance_m(8, 0.25)).epsilon(0.02));
  CHECK(irritant_distance_m(8, 0.5) == Approx(16 * 0.5755).epsilon(1e-3));
  CHECK(irritant_distance_m(8, 2) == 0);
}
