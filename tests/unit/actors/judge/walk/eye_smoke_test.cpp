// Values at eyes between two states.
#include "actors/judge/walk/eye_smoke.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

TEST_CASE("weights of states are linear between their times and add up to one", "[walk]") {
  const std::vector<double> times{0, 30, 90};
  for (const double t : {-5.0, 0.0, 10.0, 30.0, 45.0, 90.0, 100.0}) {
    double sum = 0;
    for (size_t i = 0; i < times.size(); ++i) sum += weight_of_state(times, i, t);
    CHECK(sum == Approx(1));
  }
  CHECK(weight_of_state(times, 0, 10) == Approx(2.0 / 3));
  CHECK(weight_of_state(times, 1, 45) == Approx(0.75));
  CHECK(weight_of_state(times, 2, 45) == Approx(0.25));
  CHECK(weight_of_state({7}, 0, 1000) == 1);
}
