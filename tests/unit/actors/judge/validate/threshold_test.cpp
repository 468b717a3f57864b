#include "actors/judge/validate/threshold.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

namespace luxodus::light {
namespace {

using Catch::Matchers::Contains;

/// Beer's law: a level of 5000 at an optical depth of 0, with a relative error.
LevelAt falling(double relative_error) {
  return [=](double depth) -> Result<Uncertain> {
    const double level = 5000 * std::exp(-depth);
    return Uncertain{level, relative_error * level};
  };
}

Crossing found(const LevelAt& level, const Interval& searched, double limit,
               double tolerance = 1e-4) {
  ThresholdFinder finder(level, searched, tolerance);
  const auto crossing = finder.crossing(limit);
  REQUIRE(crossing.ok());
  return crossing.value();
}

}  // namespace

TEST_CASE("the threshold of an exponential level is found, with its error",
          "[validate][experiments]") {
  for (const double limit : {1.0, 7.0}) {
    const Crossing crossing = found(falling(0.03), {0.5, 16}, limit);
    REQUIRE(crossing.at);
    CHECK(crossing.at->value == Approx(std::log(5000 / limit)).margin(2e-4));
    CHECK(crossing.at->error == Approx(0.03).epsilon(0.01));  // d ln(level) = -d depth
  }
}

TEST_CASE("the threshold of a level that bends, jumps or rises is found",
          "[validate][experiments]") {
  const auto sure = [](double level) { return Uncertain{level, 0}; };
  // Level over distance in clear air.
  const LevelAt far = [&](double m) -> Result<Uncertain> { return sure(1e4 / (m * m + m)); };
  CHECK(found(far, {2, 400}, 1).at->value == Approx((std::sqrt(1 + 4e4) - 1) / 2).margin(1e-3));
  // Level over contrast, which starts at nothing.
  const LevelAt contrast = [&](double c) -> Result<Uncertain> { return sure(100 * c); };
  CHECK(found(contrast, {1e-4, 1}, 1, 1e-6).at->value == Approx(0.01).margin(1e-5));
  CHECK(found(contrast, {0, 1}, 1, 1e-6).at->value == Approx(0.01).margin(1e-5));
  // A level that falls to nothing between two values.
  const LevelAt step = [&](double x) -> Result<Uncertain> { return sure(x < 3 ? 50 : 0); };
  CHECK(found(step, {0, 10}, 7).at->value == Approx(3).margin(2e-3));
}

TEST_CASE("a level that does not pass the limit has no threshold", "[validate][experiments]") {
  const Crossing above = found(falling(0), {0.5, 4}, 1), below = found(falling(0), {10, 16}, 1);
  CHECK_FALSE(above.at);
  CHECK(above.always_above);
  CHECK_FALSE(below.at);
  CHECK_FALSE(below.always_above);
}

TEST_CASE("two thresholds of one level share what was computed", "[validate][experiments]") {
  size_t calls = 0;
  ThresholdFinder finder(
      [&](double depth) {
        ++calls;
        return falling(0)(depth);
      },
      {0.5, 16}, 1e-3);
  REQUIRE(finder.crossing(1).ok());
  REQUIRE(finder.crossing(7).ok());
  CHECK(calls == finder.computed());
  CHECK(calls < 8);
}

TEST_CASE("a threshold has at least the error by which independent levels scatter",
          "[validate][experiments]") {
  const Crossing crossing = found(falling(0.01), {0.5, 16}, 1);
  const double at = crossing.at->value;
  CHECK(crossing.slope == Approx(-1).epsilon(1e-3));
  // Levels that would pass the limit 0.2 nearer and farther.
  const std::vector<Uncertain> others{{std::exp(0.2), 0}, {std::exp(-0.2), 0}};
  const Crossing wide = refined(crossing, 1, others);
  CHECK(wide.at->value == Approx(at).margin(1e-3));
  CHECK(wide.at->error == Approx(0.2 / std::sqrt(3.0)).epsilon(1e-2));
  const std::vector<Uncertain> same{{1, 0}, {1, 0}};
  CHECK(refined(crossing, 1, same).at->error == Approx(0.01 / std::sqrt(3.0)).epsilon(0.02));
  CHECK(refined(crossing, 1, {}).at->error == crossing.at->error);
}

TEST_CASE("a level that cannot be computed ends the search", "[validate][experiments]") {
  ThresholdFinder finder([](double) -> Result<Uncertain> { return problem("no level"); }, {1, 2},
                         0.1);
  const auto crossing = finder.crossing(1);
  REQUIRE_FALSE(crossing.ok());
  CHECK_THAT(crossing.problem().text(), Contains("no level"));
}

}  // namespace luxodus::light
