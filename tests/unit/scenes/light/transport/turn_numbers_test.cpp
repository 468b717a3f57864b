// Uniform numbers for the parts that a path is split into.
#include "scenes/light/transport/turn_numbers.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/core/random.hpp"

using namespace luxodus;

TEST_CASE("flights of a path's parts are evenly spaced in the unit interval", "[transport]") {
  for (const int parts : {1, 2, 3, 4}) {
    for (const uint32_t bits : {0u, 5u, 0xFFFFFFFFu}) {
      CHECK(bits_of_part(bits, 0, parts) == bits);
      for (int i = 1; i < parts; ++i) {
        const uint32_t step = bits_of_part(bits, i, parts) - bits_of_part(bits, i - 1, parts);
        CHECK(step * 0x1p-32 == Approx(1.0 / parts));
      }
    }
  }
}

TEST_CASE("numbers of every part of a path are uniform and below one", "[transport]") {
  Random random(1, RandomStream::test);
  random.start(0);
  constexpr int draws = 100'000;
  for (const int part : {0, 1, 3}) {
    double sums[4] = {}, products = 0;
    for (int i = 0; i < draws; ++i) {
      TurnNumbers numbers;
      numbers.choice = random.uniform_double();
      numbers.lobe = random.uniform();
      numbers.u = random.uniform();
      numbers.v = random.uniform();
      const TurnNumbers own = numbers.of_part(part);
      const double values[4] = {own.choice, static_cast<double>(own.lobe),
                                static_cast<double>(own.u), static_cast<double>(own.v)};
      for (int k = 0; k < 4; ++k) {
        if (!(values[k] >= 0 && values[k] < 1)) FAIL("outside of the unit interval");
        sums[k] += values[k] / draws;
      }
      products += values[2] * values[3] / draws;
    }
    const double error = 1 / std::sqrt(12.0 * draws);
    for (const double sum : sums) CHECK(std::abs(sum - 0.5) < 4 * error);
    CHECK(std::abs(products - 0.25) < 4 * error);
  }
}

TEST_CASE("a direction that is not guided is guided in no part of the path", "[transport]") {
  const TurnNumbers numbers;
  CHECK(numbers.of_part(0).choice == 1);
  CHECK(numbers.of_part(1).choice == 1);
}
