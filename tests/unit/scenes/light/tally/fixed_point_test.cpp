#include "scenes/light/tally/fixed_point.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/core/random.hpp"
#include "scenes/light/tally/energy_balance.hpp"

using namespace luxodus;

TEST_CASE("a split has the expectation of the fraction and never creates weight", "[tally]") {
  Random random(7, RandomStream::test);
  random.start(0);
  for (const Weight weight : {Weight{1}, Weight{5}, unit_weight / 8 + 1, unit_weight}) {
    for (const double share : {1e-9, 0.25, 0.5, 0.999, 1 - 1e-9}) {
      const Fraction fraction = to_fraction(share);
      // The result is one of two neighbouring integers, so a run's mean errs by at most half a unit
      // over sqrt(n).
      constexpr int n = 20'000;
      const double expected = static_cast<double>(weight) * from_fraction(fraction);
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        const Weight part = split(weight, fraction, random.bits());
        REQUIRE(part <= weight);
        sum += static_cast<double>(part) - expected;
      }
      INFO(weight << " x " << share);
      CHECK(std::abs(sum / n) < 5 * 0.5 / std::sqrt(n));
    }
  }
}

TEST_CASE("a split by 0 or 1 is exact for any random bits", "[tally]") {
  for (const uint32_t r : {0u, 1u, 0x80000000u, 0xFFFFFFFFu}) {
    CHECK(split(unit_weight, unit_weight, r) == unit_weight);
    CHECK(split(12345, unit_weight, r) == 12345);
    CHECK(split(unit_weight, 0, r) == 0);
  }
}

TEST_CASE("a fraction outside 0 to 1 is clamped, and NaN becomes 0", "[tally]") {
  CHECK(to_fraction(1.0) == unit_weight);
  CHECK(to_fraction(1.5) == unit_weight);
  CHECK(to_fraction(-0.1) == 0);
  CHECK(to_fraction(std::nan("")) == 0);
  CHECK(from_fraction(to_fraction(0.375)) == 0.375);
}

TEST_CASE("a balance closes if all weight is accounted for, and not if a unit is missing",
          "[tally]") {
  EnergyBalance one;
  one.emitted = 100;
  one.roulette_gain = 7;
  one.absorbed_surfaces = 50;
  one.absorbed_media = 30;
  one.escaped = 20;
  one.roulette_loss = 6;
  one.lost_too_long = 1;
  one.rays = 3;
  CHECK(one.closes());
  EnergyBalance sum;
  CHECK(sum.closes());
  sum.add(one);
  sum.add(one);
  CHECK(sum.closes());
  CHECK(sum.emitted == 200);
  CHECK(sum.rays == 6);
  CHECK(sum.lost() == 2);
  sum.escaped -= 1;
  CHECK_FALSE(sum.closes());
}
