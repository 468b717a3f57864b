// Bands: sums that they must preserve, and where they must and must not split.
#include "scenes/light/optics/bands.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

using namespace luxodus;

namespace {

Spectrum made(double (*f)(double)) {
  Spectrum s;
  for (int i = 0; i < spectrum_samples; ++i)
    s.value[static_cast<size_t>(i)] = f(Spectrum::wavelength_nm(i));
  return s;
}

Spectrum step_at_580() {
  return made([](double w) { return w < 580 ? 0.1 : 0.6; });
}
Spectrum smoke_of_angstrom_one() {
  return made([](double w) { return 633 / w; });
}

const std::vector<double> one_band{380, 780};
const std::vector<double> odd_edges{380, 417.3, 500, 555.5, 602, 780};

bool ascends_from_end_to_end(const std::vector<double>& edges) {
  return edges.size() >= 2 && edges.front() == 380 && edges.back() == 780 &&
         std::is_sorted(edges.begin(), edges.end(), std::less_equal<>());
}

}  // namespace

TEST_CASE("the light of the scene summed over bands is its spectral flux", "[optics][bands]") {
  for (const Spectrum& e : {illuminant_a_shape(), illuminant_d65_shape(), white_led_shape(4000),
                            blackbody_shape(1400), equal_energy_shape()}) {
    const Bands bands(odd_edges, e);
    double watts = 0, lumens = 0, scotopic = 0, x = 0, z = 0;
    for (int b = 0; b < bands.count(); ++b) {
      const double w = bands.power(e, b);
      watts += w;
      lumens += w * bands[b].lm_per_w;
      scotopic += w * bands[b].scotopic_lm_per_w;
      x += w * bands[b].x_per_w;
      z += w * bands[b].z_per_w;
    }
    CHECK(watts == Approx(1).epsilon(1e-12));
    // Edges off the grid cut the polylines, but the sum over all bands is exact to rounding.
    CHECK(lumens == Approx(683 * e.integral_with(cie_y())).epsilon(1e-12));
    CHECK(scotopic == Approx(1700.05 * e.integral_with(cie_scotopic())).epsilon(1e-12));
    CHECK(x == Approx(683 * e.integral_with(cie_x())).epsilon(1e-12));
    CHECK(z == Approx(683 * e.integral_with(cie_z())).epsilon(1e-12));
  }
}

TEST_CASE("light of any shape keeps its lumens and its colour in bands weighted by other light",
          "[optics][bands]") {
  // Six bands as coarse as those of real scenes, weighted by lamps.
  const Bands bands({380, 455, 500, 550, 600, 650, 780}, white_led_shape(4000));
  const Spectrum green = emission_shape_from_linear_srgb(0.0168, 0.2122, 0.0843);
  for (const Spectrum& e : {green, illuminant_a_shape(), illuminant_d65_shape(),
                            white_led_shape(2700), blackbody_shape(1400), equal_energy_shape()}) {
    const std::vector<double> watts = bands.powers(e, 300);
    double x = 0, y = 0, z = 0;
    for (int b = 0; b < bands.count(); ++b) {
      const double w = watts[static_cast<size_t>(b)];
      CHECK(w > 0);
      x += w * bands[b].x_per_w;
      y += w * bands[b].lm_per_w;
      z += w * bands[b].z_per_w;
    }
    CHECK(y == Approx(300).epsilon(1e-12));
    const double lit = e.integral_with(cie_y());
    CHECK(x / y == Approx(e.integral_with(cie_x()) / lit).epsilon(1e-6));
    CHECK(z / y == Approx(e.integral_with(cie_z()) / lit).epsilon(1e-6));
  }
}

TEST_CASE("the scene's own light keeps its spectrum, and two bands keep the lumens alone",
          "[optics][bands]") {
  const Spectrum lamp = white_led_shape(4000);
  const Bands own({380, 455, 500, 550, 600, 650, 780}, lamp);
  const double lumens = efficacy_lm_per_w(lamp);  // of one watt
  const std::vector<double> watts = own.powers(lamp, lumens);
  for (int b = 0; b < own.count(); ++b)
    CHECK(watts[static_cast<size_t>(b)] == Approx(own.power(lamp, b)).epsilon(1e-9));
  const Bands two({380, 550, 780}, lamp);
  const Spectrum flame = blackbody_shape(1400);
  const std::vector<double> scaled = two.powers(flame, 100);
  CHECK(scaled[0] * two[0].lm_per_w + scaled[1] * two[1].lm_per_w == Approx(100));
  CHECK(scaled[0] / scaled[1] == Approx(two.power(flame, 0) / two.power(flame, 1)));
}

TEST_CASE("light in deep red bands alone, which have one colour, keeps its lumens",
          "[optics][bands]") {
  const Bands bands({380, 600, 700, 720, 740, 780}, white_led_shape(4000));
  for (const double from : {605.0, 700.0}) {
    Spectrum red;
    for (int i = 0; i < spectrum_samples; ++i)
      red.value[static_cast<size_t>(i)] = Spectrum::wavelength_nm(i) > from ? 1 : 0;
    double lumens = 0;
    const std::vector<double> watts = bands.powers(red, 20);
    for (int b = 0; b < bands.count(); ++b) {
      CHECK(std::isfinite(watts[static_cast<size_t>(b)]));
      CHECK(watts[static_cast<size_t>(b)] >= 0);
      lumens += watts[static_cast<size_t>(b)] * bands[b].lm_per_w;
    }
    CHECK(lumens == Approx(20));
  }
}

TEST_CASE("a colour that the bands cannot represent is approximated, and no band becomes dark",
          "[optics][bands]") {
  // A laser in bands of 4000 K lamps: only its own band holds its light.
  const Bands bands({380, 455, 500, 550, 600, 650, 780}, white_led_shape(4000));
  const Spectrum laser = made([](double w) { return std::abs(w - 532) < 6 ? 1.0 : 1e-4; });
  const std::vector<double> watts = bands.powers(laser, 100);
  double lumens = 0, plain = 0;
  for (int b = 0; b < bands.count(); ++b) plain += bands.power(laser, b) * bands[b].lm_per_w;
  for (int b = 0; b < bands.count(); ++b) {
    const double w = watts[static_cast<size_t>(b)];
    CHECK(w >= 0.199 * bands.power(laser, b) * 100 / plain);
    lumens += w * bands[b].lm_per_w;
  }
  CHECK(lumens == Approx(100).epsilon(1e-9));
}

TEST_CASE("in narrow bands, light of another shape keeps its watts, and nearly its lumens",
          "[optics][bands]") {
  std::vector<double> edges;
  for (double w = 380; w <= 780; w += 20) edges.push_back(w);
  const Bands bands(edges, illuminant_a_shape());
  const Spectrum d65 = illuminant_d65_shape();
  double watts = 0, lumens = 0;
  for (int b = 0; b < bands.count(); ++b) {
    watts += bands.power(d65, b);
    lumens += bands.power(d65, b) * bands[b].lm_per_w;
  }
  CHECK(watts == Approx(1).epsilon(1e-12));
  CHECK(lumens == Approx(efficacy_lm_per_w(d65)).epsilon(5e-3));
}

TEST_CASE("the average of a constant is that constant in every band, lit or dark",
          "[optics][bands]") {
  Spectrum red_only;
  for (size_t i = 60; i < 70; ++i) red_only.value[i] = 1;
  const Bands bands(odd_edges, red_only);
  for (int b = 0; b < bands.count(); ++b)
    CHECK(bands.average(Spectrum::constant(0.37), b) == Approx(0.37).epsilon(1e-14));
}

TEST_CASE("a band without emission is weighted by equal energy", "[optics][bands]") {
  Spectrum red_only;
  for (size_t i = 60; i < 70; ++i) red_only.value[i] = 1;
  const Bands dark({380, 560, 580, 780}, red_only);
  const Bands even({380, 560, 580, 780}, equal_energy_shape());
  CHECK(dark[1].lm_per_w == Approx(even[1].lm_per_w));
  CHECK(dark.average(step_at_580(), 1) == Approx(even.average(step_at_580(), 1)));
  const Bands nothing(one_band, Spectrum{});
  CHECK(nothing[0].lm_per_w == Approx(efficacy_lm_per_w(equal_energy_shape())));
}

TEST_CASE("an average gives the luminance reflected by a coloured wall", "[optics][bands]") {
  const Spectrum e = illuminant_d65_shape();
  const Spectrum r = reflectance_from_linear_srgb(0.4, 0.25, 0.1);
  const Bands bands(one_band, e);
  const double luminous = (e * r).integral_with(cie_y()) / e.integral_with(cie_y());
  CHECK(bands.average(r, 0) == Approx(luminous).epsilon(0.03));
}

TEST_CASE("edges that do not ascend from 380 to 780 nm are a programmer's mistake",
          "[optics][bands]") {
  using Edges = std::vector<double>;
  for (const Edges& bad : {Edges{}, Edges{380}, Edges{400, 780}, Edges{380, 700},
                           Edges{380, 600, 500, 780}, Edges{380, 500, 500, 780}})
    CHECK_THROWS_AS(Bands(bad, equal_energy_shape()), std::invalid_argument);
}

TEST_CASE("a grey scene with one emission shape has one band", "[optics][bands]") {
  CHECK(told_apart({Spectrum::constant(0.5), Spectrum::constant(0.05)}, {illuminant_a_shape()},
                   0.02, 8) == one_band);
  CHECK(told_apart({}, {}, 0.02, 8) == one_band);
}

TEST_CASE("emissions of one shape never split, whatever their strength", "[optics][bands]") {
  const Spectrum led = white_led_shape(3000);
  CHECK(told_apart({Spectrum::constant(0.5)}, {led, led * 1e6, led * 1e-3}, 0.0, 8) == one_band);
}

TEST_CASE("emissions of two shapes split even in a grey room", "[optics][bands]") {
  const auto edges = told_apart({Spectrum::constant(0.5)},
                                {white_led_shape(6500), blackbody_shape(1400)}, 0.02, 8);
  CHECK(ascends_from_end_to_end(edges));
  CHECK(edges.size() > 2);
  CHECK(edges.size() <= 9);
}

TEST_CASE("a step in a reflectance puts an edge at the step", "[optics][bands]") {
  const auto edges = told_apart({step_at_580()}, {equal_energy_shape()}, 0.02, 8);
  CHECK(std::count(edges.begin(), edges.end(), 580.0) == 1);
  // The polyline climbs from 575 to 580 nm, so one bin before the step may stand alone, but no
  // other.
  CHECK(edges.size() <= 4);
  CHECK(told_apart({step_at_580()}, {equal_energy_shape()}, 0.02, 2) ==
        std::vector<double>{380, 580, 780});
}

TEST_CASE(
    "smoke whose extinction falls with wavelength has several bands, and no more than allowed",
    "[optics][bands]") {
  for (int most : {1, 2, 3, 5, 8, 20}) {
    const auto edges = told_apart({smoke_of_angstrom_one()}, {equal_energy_shape()}, 0.02, most);
    CHECK(ascends_from_end_to_end(edges));
    CHECK(static_cast<int>(edges.size()) - 1 <= most);
    if (most >= 2) CHECK(edges.size() > 2);
  }
  CHECK(told_apart({smoke_of_angstrom_one()}, {equal_energy_shape()}, 0.9, 8) == one_band);
}

TEST_CASE("bands merged by tolerance differ by more than the tolerance", "[optics][bands]") {
  const Spectrum smoke = smoke_of_angstrom_one();
  const double tolerance = 0.06;
  const auto edges = told_apart({smoke}, {equal_energy_shape()}, tolerance, 20);
  const Bands bands(edges, equal_energy_shape());
  REQUIRE(bands.count() > 2);
  for (int b = 0; b + 1 < bands.count(); ++b)
    CHECK(std::abs(bands.average(smoke, b) - bands.average(smoke, b + 1)) / smoke.at(380) >
          tolerance);
}

TEST_CASE("colours in the dark part of the spectrum are not distinguished", "[optics][bands]") {
  Spectrum blue_only;
  for (size_t i = 0; i < 24; ++i) blue_only.value[i] = 1;  // 380..495 nm
  CHECK(told_apart({step_at_580()}, {blue_only}, 0.02, 8) == one_band);
}
