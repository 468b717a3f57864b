#include "scenes/light/vision/mesopic.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/light/optics/chromaticity.hpp"

using namespace luxodus;

TEST_CASE("mesopic luminance has the check values of CIE 191", "[vision][mesopic]") {
  struct Row {
    double photopic, scotopic_ratio, mesopic;
  };
  for (const Row& r :
       {Row{0.01, 2.05, 0.0169}, Row{0.1, 2.05, 0.1324}, Row{1, 2.05, 1.106}, Row{3, 2.05, 3.092},
        Row{0.01, 0.65, 0.0069}, Row{0.1, 0.65, 0.0873}, Row{1, 0.65, 0.961}, Row{3, 0.65, 2.967}})
    CHECK(mesopic_luminance(r.photopic, r.photopic * r.scotopic_ratio).cd_m2 ==
          Approx(r.mesopic).epsilon(5e-3));
  CHECK(mesopic_luminance(0.01, 0.0205).adaptation == Approx(0.176).margin(6e-4));
  CHECK(mesopic_luminance(0.1, 0.205).adaptation == Approx(0.474).margin(6e-4));
  CHECK(mesopic_luminance(1, 2.05).adaptation == Approx(0.782).margin(6e-4));
  CHECK(mesopic_luminance(3, 6.15).adaptation == Approx(0.930).margin(6e-4));
}

TEST_CASE("bright light is photopic and very dim light scotopic", "[vision][mesopic]") {
  CHECK(mesopic_luminance(10, 25).cd_m2 == 10);
  CHECK(mesopic_luminance(10, 25).adaptation == 1);
  CHECK(mesopic_luminance(0.001, 0.0025).cd_m2 == Approx(0.0025));
  CHECK(mesopic_luminance(0.001, 0.0025).adaptation == 0);
}

TEST_CASE("mesopic luminance satisfies its defining equation and grows with the light",
          "[vision][mesopic]") {
  for (double ratio : {0.3, 0.65, 1.4, 2.05, 3.5, 8.0}) {
    double before = 0;
    for (double l = 1e-4; l < 100; l *= 1.1) {
      const MesopicLuminance m = mesopic_luminance(l, l * ratio);
      const double fixed = std::min(1.0, std::max(0.0, 0.7670 + 0.3334 * std::log10(m.cd_m2)));
      CHECK(m.adaptation == Approx(fixed).margin(1e-9));
      CHECK(m.cd_m2 > before);
      before = m.cd_m2;
    }
  }
}

TEST_CASE("darkness and invalid values give 0", "[vision][mesopic]") {
  CHECK(mesopic_luminance(0, 0).cd_m2 == 0);
  CHECK(mesopic_luminance(-1, -1).cd_m2 == 0);
  CHECK(mesopic_luminance(std::nan(""), 0).cd_m2 == 0);
}

TEST_CASE("scotopic luminance estimated from XYZ is close to the spectral one for lamps",
          "[vision][mesopic]") {
  for (const Spectrum& s : {illuminant_d65_shape(), illuminant_a_shape(), equal_energy_shape(),
                            white_led_shape(4000)}) {
    const Xyz c = xyz_of(s);
    const double scotopic =
        scotopic_efficacy_lm_per_w * s.integral_with(cie_scotopic()) / luminous_efficacy_lm_per_w;
    CHECK(scotopic_from_xyz(c[0], c[1], c[2]) == Approx(scotopic).epsilon(0.12));
  }
  CHECK(scotopic_from_xyz(0, 1, 0) > 0);
  CHECK(scotopic_from_xyz(0, 0, 0) == 0);
}
