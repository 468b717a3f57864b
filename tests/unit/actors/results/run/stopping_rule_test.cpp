// When a run stops, as a table of rules and progress.
#include "actors/results/run/stopping_rule.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace luxodus {
namespace {

constexpr int64_t batch = 1000;

StopRule particles(int64_t count) {
  StopRule stop;
  stop.particles = count;
  return stop;
}
StopRule error(double relative) {
  StopRule stop;
  stop.relative_error = relative;
  return stop;
}

std::optional<StopReason> reason(const StopRule& stop, RunProgress run) {
  return stop.reason_to_stop(run, batch);
}

}  // namespace

TEST_CASE("particles are rounded up to whole batches", "[run][stop]") {
  CHECK(particles(1).target_batches(batch) == 1);
  CHECK(particles(1000).target_batches(batch) == 1);
  CHECK(particles(1001).target_batches(batch) == 2);
  CHECK(error(0.1).target_batches(batch) == std::numeric_limits<int64_t>::max());
}

TEST_CASE("a run stops at the first limit that is reached", "[run][stop]") {
  StopRule both = particles(4000);
  both.relative_error = 0.01;
  CHECK_FALSE(reason(both, {3, 0.02}));
  CHECK(reason(both, {3, 0.01}) == StopReason::error);
  CHECK(reason(both, {4, 0.02}) == StopReason::particles);
  CHECK(reason(both, {4, 0.01}) == StopReason::error);
  CHECK(reason(both, {1, 0.02, false, true}) == StopReason::time);
  CHECK(reason(both, {4, 0.01, true, true}) == StopReason::interrupted);
}

TEST_CASE("an unknown error stops no run", "[run][stop]") {
  CHECK_FALSE(reason(error(0.01), {5, std::numeric_limits<double>::quiet_NaN()}));
  CHECK_FALSE(reason(error(0.01), {5, std::numeric_limits<double>::infinity()}));
  CHECK_FALSE(particles(10).error_is_reached(0));
}

TEST_CASE("time is over at the requested second, and never without a limit", "[run][stop]") {
  StopRule stop;
  CHECK_FALSE(stop.time_is_up(1e9));
  stop.seconds = 2;
  CHECK_FALSE(stop.time_is_up(1.999));
  CHECK(stop.time_is_up(2));
}

TEST_CASE("the remaining time is estimated from particles, error and time", "[run][stop]") {
  const auto left = [](const StopRule& stop, int64_t batches, double seconds, double error) {
    return progress_of(stop, batch, 0, batches, seconds, error).seconds_left;
  };
  CHECK(left(particles(4000), 1, 2, 1) == Approx(6));
  CHECK(left(error(0.01), 1, 2, 0.02) == Approx(6));  // four times the work in all
  CHECK(std::isnan(left(error(0.01), 0, 2, std::numeric_limits<double>::quiet_NaN())));
  StopRule time = particles(4000);
  time.seconds = 5;
  CHECK(left(time, 1, 2, 1) == Approx(3));
}

}  // namespace luxodus
