#include "scenes/emergency/eyes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/emergency/legibility.hpp"
#include "scenes/light/optics/chromaticity.hpp"

using namespace luxodus;

namespace {

/// Protan luminance over luminance.
double share_of(const Spectrum& light) {
  const Tristimulus xyz = xyz_of(light);
  return protan_luminance(xyz) / xyz[1];
}

}  // namespace

TEST_CASE("protan eyes see white as bright, red much darker, green and blue somewhat brighter",
          "[emergency][eyes]") {
  CHECK(share_of(equal_energy_shape()) == Approx(1).epsilon(1e-3));
  const double red = share_of(coloured_led_shape(LedColour::red));
  CHECK(red > 0.15);
  CHECK(red < 0.3);
  CHECK(share_of(coloured_led_shape(LedColour::green)) > 1);
  CHECK(share_of(coloured_led_shape(LedColour::blue)) > 1);
}

TEST_CASE("the chromatic difference is that of CIE 1976 u' and v'", "[emergency][eyes]") {
  // u' = 4 X / (X + 15 Y + 3 Z), v' = 9 Y / (...): white (4/19, 9/19) and sRGB red (0.4507,
  // 0.5229).
  const Tristimulus white{1, 1, 1}, red{0.4124, 0.2126, 0.0193};
  CHECK(chromatic_difference(white, red) ==
        Approx(std::hypot(0.4507 - 4 / 19.0, 0.5229 - 9 / 19.0)).epsilon(1e-3));
  CHECK(chromatic_difference(white, {2, 2, 2}) == Approx(0).margin(1e-12));
  CHECK(std::isnan(chromatic_difference(white, {0, 0, 0})));
}

TEST_CASE("a red legend on a dark ground is as much darker to protan eyes as its light is",
          "[emergency][eyes]") {
  const Tristimulus red = xyz_of(coloured_led_shape(LedColour::red));
  SignLook look;
  look.legend = look.difference = {40, 1};
  look.surround = {5, 0.1};
  look.veil_cd_m2 = 2;
  look.colours.room = {1, 1, 1};
  for (size_t k = 0; k < 3; ++k)
    look.colours.legend[k] = look.colours.difference[k] = 40 * red[k] / red[1];
  const double share = share_of(coloured_led_shape(LedColour::red));
  const SignLook seen = as_protan_eyes_see(look);
  CHECK(seen.legend.value == Approx(40 * share));
  CHECK(seen.difference.value == Approx(40 * share));
  CHECK(seen.legend.error == Approx(share));
  CHECK(seen.surround.value == Approx(5).epsilon(1e-3));
  CHECK(seen.veil_cd_m2 == Approx(2).epsilon(1e-3));
  // Light of unknown colour is kept.
  look.colours = {};
  CHECK(as_protan_eyes_see(look).legend.value == 40);
}
