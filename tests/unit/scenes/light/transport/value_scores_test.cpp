// Values as integer scores: how fine they are, and what is no score.
#include "scenes/light/transport/value_scores.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "scenes/light/tally/batch_scores.hpp"

using namespace luxodus;

TEST_CASE("the quantum of light is a power of two that follows the flux of a scene",
          "[transport][values]") {
  for (const double flux : {1.0, 70.0, 1e6, 0.0})
    CHECK(light_quantum_of(flux) == limits::value_quantum);
  for (const double flux : {1e-9, 0.5, 1.5e6, 1e9, 1e12}) {
    const double quantum = light_quantum_of(flux);
    INFO(flux << " lm");
    int exponent = 0;
    CHECK(std::frexp(quantum, &exponent) == 0.5);
    // A scene's flux is 2^39 to 2^61 quanta.
    CHECK(flux / quantum >= 0x1p39);
    CHECK(flux / quantum <= 0x1p61);
  }
}

TEST_CASE("a value that no score holds is marked, never cut off", "[transport][values]") {
  constexpr double quantum = 0x1p-40;
  CHECK(value_score(3, quantum) == int64_t{3} << 40);
  CHECK(value_score(-0.5, quantum) == -(int64_t{1} << 39));
  CHECK(value_score(0x1p22, quantum) == int64_t{1} << 62);
  for (const double beyond :
       {0x1.000001p22, -0x1.000001p22, 1e300, std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()})
    CHECK(value_score(beyond, quantum) == limits::out_of_range);
}
