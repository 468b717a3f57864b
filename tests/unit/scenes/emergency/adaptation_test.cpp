#include "scenes/emergency/adaptation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/emergency/sight.hpp"

using namespace luxodus;

TEST_CASE("a lit room bleaches a few per cent of the rhodopsin", "[emergency][adaptation]") {
  // 100 cd/m2 through a pupil of 6.6 mm2 are 660 td, and 1490 scotopic td. By hand:
  // 1490 / (1490 + 25119) = 0.056.
  CHECK(bleached_rhodopsin(100, 0) == Approx(0.056).epsilon(0.02));
  CHECK(bleached_rhodopsin(0, 0) == 0);
}

TEST_CASE("rhodopsin recovers at a limited rate, in the end by 0.24 in log10 per minute",
          "[emergency][adaptation]") {
  // The rate equation, step by step.
  const double step_s = 0.01, k = 0.2, rate = 0.09 / 60;
  double share = bleached_rhodopsin(1000, 0);
  for (int i = 0; i < 30'000; ++i) share -= step_s * rate * (1 + k) * share / (share + k);
  CHECK(bleached_rhodopsin(1000, 300) == Approx(share).epsilon(1e-4));
  const double per_minute = std::log10(bleached_rhodopsin(100, 900) / bleached_rhodopsin(100, 960));
  CHECK(per_minute == Approx(0.24).epsilon(0.03));
}

TEST_CASE("what is bleached lifts the threshold in the dark, and soon no more",
          "[emergency][adaptation]") {
  CHECK(equivalent_background(0, 0) == 0);
  double last = equivalent_background(100, 0);
  CHECK(last == Approx(0.005 * 0.056 / 0.12).epsilon(0.03));
  for (const double seconds : {5.0, 60.0, 300.0, 1800.0}) {
    const double now = equivalent_background(100, seconds);
    INFO(seconds << " s");
    CHECK(now < last);
    last = now;
  }
  CHECK(last < 1e-6);
  CHECK(equivalent_background(300, 60) > equivalent_background(100, 60));
}

TEST_CASE("an equivalent background acts as a background, and not on the difference",
          "[emergency][adaptation]") {
  const Eye adapted{23, 2}, from_light{23, 2, 0.002};
  CHECK(luminance_threshold(0, 30, false, from_light) ==
        luminance_threshold(0.002, 30, false, adapted));
  CHECK(visibility_level(0.01, 0, 30, from_light) ==
        Approx(0.01 / luminance_threshold(0.002, 30, false, adapted)));
  // Before emergency lighting it no longer counts.
  CHECK(luminance_threshold(0.25, 30, false, from_light) ==
        Approx(luminance_threshold(0.25, 30, false, adapted)).epsilon(0.01));
}
