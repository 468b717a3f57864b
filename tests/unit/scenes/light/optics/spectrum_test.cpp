// The CIE's tables compared with what the standards state, illuminants, black bodies, and spectra
// made from colours.
#include "scenes/light/optics/spectrum.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/light/optics/chromaticity.hpp"
#include "tests/kit/visible_share.hpp"

using namespace luxodus;

namespace {

std::array<double, 2> xy(const Spectrum& s) {
  const Xyz c = xyz_of(s);
  const double sum = c[0] + c[1] + c[2];
  return {c[0] / sum, c[1] / sum};
}

double sum(const Spectrum& s) {
  double total = 0;
  for (double v : s.value) total += v;
  return total;
}

double scotopic_over_photopic(const Spectrum& s) {
  return scotopic_efficacy_lm_per_w * s.integral_with(cie_scotopic()) /
         (luminous_efficacy_lm_per_w * s.integral_with(cie_y()));
}

// Linear sRGB of a surface under equal energy, for an observer adapted to it.
std::array<double, 3> colour_of_reflectance(const Spectrum& r) {
  const Spectrum light = equal_energy_shape();
  const double white_y = light.integral_with(cie_y());
  Xyz c = xyz_of(light * r);
  Xyz white = xyz_of(light);
  for (double& v : c) v /= white_y;
  for (double& v : white) v /= white_y;
  return linear_srgb_from_xyz(adapt_white(c, white, d65_white));
}

double largest_difference(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double most = 0;
  for (size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("the colour-matching tables have the sums the CIE states for 5 nm",
          "[optics][spectrum]") {
  // CIE 015 table T.4, foot: 21.371524, 21.371327, 21.371540 over 380..780 nm.
  CHECK(sum(cie_x()) == Approx(21.371524).epsilon(1e-9));
  CHECK(sum(cie_y()) == Approx(21.371327).epsilon(1e-9));
  CHECK(sum(cie_z()) == Approx(21.371540).epsilon(1e-9));
  CHECK(cie_y().at(555) == 1.0);
  CHECK(cie_x().at(440) == 0.34828);
}

TEST_CASE("photopic and scotopic efficiency agree at the definition of the candela",
          "[optics][spectrum]") {
  // At 540 THz (555.016 nm) both systems give 683 lm/W: 1700.05 * V'(555.016) = 683. Linear
  // interpolation between rows adds a small error.
  CHECK(luminous_efficacy_lm_per_w * cie_y().at(555.016) == Approx(683).epsilon(1e-4));
  CHECK(scotopic_efficacy_lm_per_w * cie_scotopic().at(555.016) == Approx(683).epsilon(1e-3));
  CHECK(cie_scotopic().at(505) == 0.998);
  CHECK(cie_scotopic().at(510) == 0.997);
}

TEST_CASE("illuminants A and D65 have the chromaticities of the standard", "[optics][spectrum]") {
  const auto a = xy(illuminant_a_shape());
  CHECK(a[0] == Approx(0.44758).margin(2e-5));
  CHECK(a[1] == Approx(0.40745).margin(2e-5));
  const auto d65 = xy(illuminant_d65_shape());
  CHECK(d65[0] == Approx(0.31272).margin(2e-5));
  CHECK(d65[1] == Approx(0.32903).margin(2e-5));
}

TEST_CASE("illuminants A and D65 have the known ratios of scotopic to photopic light",
          "[optics][spectrum]") {
  CHECK(scotopic_over_photopic(illuminant_a_shape()) == Approx(1.41).margin(0.01));
  CHECK(scotopic_over_photopic(illuminant_d65_shape()) == Approx(2.47).margin(0.01));
  CHECK(scotopic_over_photopic(equal_energy_shape()) == Approx(2.26).margin(0.05));
}

TEST_CASE("luminous efficacy per visible watt is 204-206 lm/W for D65 and 155-158 lm/W for A",
          "[optics][spectrum]") {
  CHECK(efficacy_lm_per_w(illuminant_d65_shape()) == Approx(205.2).margin(0.5));
  CHECK(efficacy_lm_per_w(illuminant_a_shape()) == Approx(156.2).margin(0.5));
  // Equal energy: 683 * 106.857 nm / 400 nm.
  CHECK(efficacy_lm_per_w(equal_energy_shape()) == Approx(182.46).margin(0.02));
}

TEST_CASE("every named shape is non-negative with integral 1", "[optics][spectrum]") {
  for (const Spectrum& s :
       {blackbody_shape(10), blackbody_shape(1400), blackbody_shape(1e5), illuminant_a_shape(),
        illuminant_d65_shape(), equal_energy_shape(), white_led_shape(2700), white_led_shape(6500),
        emission_shape_from_linear_srgb(0, 1, 0.2)}) {
    CHECK(s.integral() == Approx(1).epsilon(1e-12));
    CHECK(*std::min_element(s.value.begin(), s.value.end()) >= 0);
  }
}

TEST_CASE("a spectrum is linear between its nodes and constant beyond the ends",
          "[optics][spectrum]") {
  Spectrum s;
  for (int i = 0; i < spectrum_samples; ++i)
    s.value[static_cast<size_t>(i)] = Spectrum::wavelength_nm(i);
  CHECK(s.at(381.25) == Approx(381.25));
  CHECK(s.at(777.5) == Approx(777.5));
  CHECK(s.at(100) == 380);
  CHECK(s.at(900) == 780);
  CHECK(s.integral() == Approx(0.5 * (780.0 * 780 - 380.0 * 380)));
  CHECK(Spectrum::constant(0.3).is_constant());
  CHECK(Spectrum::constant(0).is_constant());
  CHECK_FALSE(s.is_constant());
}

TEST_CASE("a black body of 1400 K gives 0.035 lm/W and one of 2856 K 16 to 17 lm/W",
          "[optics][spectrum]") {
  const auto blackbody_efficacy_lm_per_w = [](double kelvin) {
    return test::visible_share_of_black_body(kelvin) * efficacy_lm_per_w(blackbody_shape(kelvin));
  };
  // Publications on light in smoke quote 0.034 for 1400 K, which is the value of 1396 K.
  CHECK(blackbody_efficacy_lm_per_w(1400) == Approx(0.03516).epsilon(1e-3));
  CHECK(blackbody_efficacy_lm_per_w(1400) == Approx(0.034).epsilon(0.04));
  CHECK(blackbody_efficacy_lm_per_w(2000) == Approx(1.606).epsilon(1e-3));
  CHECK(blackbody_efficacy_lm_per_w(2856) > 16);
  CHECK(blackbody_efficacy_lm_per_w(2856) < 17);
  // The most efficacious black body: about 95 lm/W near 6600 K.
  CHECK(blackbody_efficacy_lm_per_w(6600) == Approx(95).margin(1));
  CHECK(blackbody_efficacy_lm_per_w(6600) > blackbody_efficacy_lm_per_w(5000));
  CHECK(blackbody_efficacy_lm_per_w(6600) > blackbody_efficacy_lm_per_w(9000));
}

TEST_CASE("colour temperature of a black body is its temperature", "[optics][chromaticity]") {
  for (double kelvin : {1400.0, 2000.0, 2856.0, 4000.0, 6500.0, 10000.0}) {
    const ColourTemperature t = correlated_colour_temperature(xyz_of(blackbody_shape(kelvin)));
    CHECK(t.kelvin == Approx(kelvin).epsilon(1e-4));
    CHECK(t.duv < 1e-6);
  }
  // CIE 015: D65 is 6504 K (on the 1968 scale of c2), 0.0032 above the locus.
  const ColourTemperature d65 = correlated_colour_temperature(xyz_of(illuminant_d65_shape()));
  CHECK(d65.kelvin == Approx(6503).margin(5));
  CHECK(d65.duv == Approx(0.0032).margin(0.0001));
}

TEST_CASE("a white LED has its colour temperature within 50 K and lies on the Planckian locus",
          "[optics][spectrum]") {
  for (double cct : {2700.0, 3000.0, 3500.0, 4000.0, 5000.0, 5700.0, 6500.0}) {
    const Spectrum led = white_led_shape(cct);
    const ColourTemperature t = correlated_colour_temperature(xyz_of(led));
    CHECK(std::abs(t.kelvin - cct) < 50);
    CHECK(t.duv < 1e-3);
    // White LEDs on the market: 300 to 350 lm per visible watt, a pump peak and a valley near 480
    // nm.
    CHECK(efficacy_lm_per_w(led) > 300);
    CHECK(efficacy_lm_per_w(led) < 350);
    CHECK(led.at(450) > 1.5 * led.at(485));
    CHECK(led.at(485) < led.at(540));
  }
  CHECK(scotopic_over_photopic(white_led_shape(2700)) <
        scotopic_over_photopic(white_led_shape(6500)));
}

TEST_CASE("linear sRGB white is the D65 white and the two matrices are inverse",
          "[optics][chromaticity]") {
  const auto white = linear_srgb_from_xyz({0.95046, 1.0, 1.08906});
  for (double v : white) CHECK(v == Approx(1).margin(1e-4));
  for (const std::array<double, 3>& rgb : {std::array{1.0, 0.0, 0.0}, std::array{0.2, 0.5, 0.9}})
    CHECK(largest_difference(linear_srgb_from_xyz(xyz_from_linear_srgb(rgb)), rgb) < 1e-9);
  // Adapting a white gives the other white, and adapting back restores the colour.
  const Xyz there = adapt_white(d65_white, d65_white, equal_energy_white);
  for (size_t i = 0; i < 3; ++i) CHECK(there[i] == Approx(1).epsilon(1e-9));
  const Xyz back = adapt_white(adapt_white({0.3, 0.2, 0.1}, d65_white, equal_energy_white),
                               equal_energy_white, d65_white);
  CHECK(largest_difference(back, {0.3, 0.2, 0.1}) < 1e-9);
}

TEST_CASE("a grey becomes a constant reflectance exactly", "[optics][spectrum]") {
  for (double v : {0.0, 0.18, 0.5, 1.0}) {
    const Spectrum s = reflectance_from_linear_srgb(v, v, v);
    for (double r : s.value) CHECK(r == v);
  }
  CHECK(reflectance_from_linear_srgb(2, 2, 2).value[0] == 1);
  CHECK(reflectance_from_linear_srgb(-1, -1, -1).value[0] == 0);
}

TEST_CASE("a reflectance made from a colour has that colour under equal energy",
          "[optics][spectrum]") {
  double inside = 0;    // components 0.02..0.9: the colours of paints
  double anywhere = 0;  // the corners of the cube too
  for (double r : {0.0, 0.02, 0.2, 0.5, 0.9, 1.0})
    for (double g : {0.0, 0.02, 0.2, 0.5, 0.9, 1.0})
      for (double b : {0.0, 0.02, 0.2, 0.5, 0.9, 1.0}) {
        const Spectrum s = reflectance_from_linear_srgb(r, g, b);
        for (double v : s.value) REQUIRE((v >= 0 && v <= 1));
        const double error = largest_difference(colour_of_reflectance(s), {r, g, b});
        anywhere = std::max(anywhere, error);
        const auto paint = [](double v) { return v >= 0.02 && v <= 0.9; };
        if (paint(r) && paint(g) && paint(b)) inside = std::max(inside, error);
      }
  INFO("largest error: paints " << inside << ", anywhere " << anywhere);
  CHECK(inside < 1e-9);
  CHECK(anywhere < 1e-6);
}

TEST_CASE("a reflectance made from a colour is smooth", "[optics][spectrum]") {
  const Spectrum green = reflectance_from_linear_srgb(0.017, 0.212, 0.084);  // sign green, #237F52
  for (size_t i = 0; i + 1 < green.value.size(); ++i)
    CHECK(std::abs(green.value[i + 1] - green.value[i]) < 0.03);
  // Near grey is nearly constant: no jump next to exact greys.
  const Spectrum near_grey = reflectance_from_linear_srgb(0.5, 0.5, 0.500001);
  for (double v : near_grey.value) CHECK(v == Approx(0.5).margin(1e-5));
}

TEST_CASE("an emission made from a colour has that chromaticity", "[optics][spectrum]") {
  for (const std::array<double, 3>& rgb :
       {std::array{1.0, 0.0, 0.0}, std::array{0.0, 1.0, 0.0}, std::array{0.0, 0.0, 1.0},
        std::array{1.0, 0.5, 0.1}, std::array{30.0, 60.0, 40.0}}) {
    const auto is =
        linear_srgb_from_xyz(xyz_of(emission_shape_from_linear_srgb(rgb[0], rgb[1], rgb[2])));
    const double scale = std::max({rgb[0], rgb[1], rgb[2]}) / std::max({is[0], is[1], is[2]});
    const double highest = std::max({rgb[0], rgb[1], rgb[2]});
    for (size_t i = 0; i < 3; ++i)
      CHECK(is[i] * scale / highest == Approx(rgb[i] / highest).margin(2e-4));
  }
  CHECK(emission_shape_from_linear_srgb(3, 3, 3).value == illuminant_d65_shape().value);
  CHECK(emission_shape_from_linear_srgb(0, 0, 0).value == illuminant_d65_shape().value);
}
