#include "scenes/light/vision/adapted_white.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace luxodus;

namespace {

/// Illuminant A, Y = 1.
const Xyz incandescent{1.0985, 1, 0.35585};

Xyz at_luminance(const Xyz& white, double cd_m2) {
  return {white[0] * cd_m2, white[1] * cd_m2, white[2] * cd_m2};
}

/// Distance of the shown colour of a light from D65 in (X/Y, Z/Y), over that of the light itself.
double colour_left(const Xyz& white, double cd_m2) {
  const Xyz light = at_luminance(white, cd_m2);
  const Xyz shown = AdaptedWhite(light, 200).on_monitor(light);
  const auto from_d65 = [](const Xyz& c) {
    return std::hypot(c[0] / c[1] - d65_white[0], c[2] / c[1] - d65_white[2]);
  };
  return from_d65(shown) / from_d65(white);
}

}  // namespace

TEST_CASE("light of the monitor's white at its luminance is shown as it is", "[vision]") {
  const Xyz light = at_luminance(d65_white, 200);
  const Xyz colour{10, 20, 5};
  const Xyz shown = AdaptedWhite(light, 200).on_monitor(colour);
  for (size_t c = 0; c < 3; ++c) CHECK(shown[c] == Approx(colour[c]));
}

TEST_CASE("adaptation is nearly complete in very bright light, and falls with the luminance",
          "[vision]") {
  CHECK(colour_left(incandescent, 1e9) < 0.05);
  double last = 0;
  for (const double cd_m2 : {1e5, 1e3, 100.0, 1.0, 0.01}) {
    const double left = colour_left(incandescent, cd_m2);
    INFO(cd_m2 << " cd/m2");
    CHECK(left > last);
    last = left;
  }
  CHECK(last < 1);
}

TEST_CASE("at one luminance the redder light keeps more of its colour", "[vision]") {
  const Xyz d50{0.9642, 1, 0.8251};
  for (const double cd_m2 : {1.0, 10.0, 100.0}) {
    INFO(cd_m2 << " cd/m2");
    CHECK(colour_left(incandescent, cd_m2) > colour_left(d50, cd_m2));
  }
}

TEST_CASE("the live view's white is that of pictures", "[vision]") {
  // The same numbers stand in tests/view/unit/white_test.mjs.
  const Xyz light = xyz_from_linear_srgb({130, 98, 50});
  const auto shown = linear_srgb_from_xyz(AdaptedWhite(light, 200).on_monitor(light));
  CHECK(shown[0] == Approx(108.457).margin(0.05));
  CHECK(shown[1] == Approx(101.088).margin(0.05));
  CHECK(shown[2] == Approx(82.885).margin(0.05));
}

TEST_CASE("an adapted colour keeps its luminance", "[vision]") {
  const Xyz shown = AdaptedWhite(at_luminance(incandescent, 30), 200).on_monitor({4, 7, 2});
  CHECK(shown[1] == Approx(7));
  CHECK(AdaptedWhite(at_luminance(incandescent, 30), 200).on_monitor({0, 0, 0})[1] == 0);
}
