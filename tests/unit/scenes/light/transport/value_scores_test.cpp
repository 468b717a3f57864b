// Values as integer scores: how fine they are, and what is no score.
#include "scenes/light/transport/value_scores.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "scenes/light/tally/batch_scores.hpp"

using namespace luxodus;

TEST_CASE("the quantum of light is a power of two that follows how bright a scene is",
          "[transport][values]") {
  for (const double level : {1e-4, 70.0, 1e4, 0.0})
    CHECK(light_quantum_of(level) == limits::value_quantum);
  for (const double level : {1e-12, 0.5e-4, 1.5e4, 1e9, 1e12}) {
    const double quantum = light_quantum_of(level);
    INFO(level << " lx");
    int exponent = 0;
    CHECK(std::frexp(quantum, &exponent) == 0.5);
    // A scene's level is 2^26 to 2^54 quanta, of the 2^62 that a score holds.
    CHECK(level / quantum >= 0x1p26);
    CHECK(level / quantum <= 0x1p54);
  }
  for (const double level : {1e-310, 1e300, std::numeric_limits<double>::infinity()})
    CHECK(std::isnormal(light_quantum_of(level)));
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
