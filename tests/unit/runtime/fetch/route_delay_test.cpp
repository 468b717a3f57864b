#include "runtime/fetch/route_delay.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

const TimeoutLimits usual{};

RouteDelay after(int answers, Nanoseconds delay) {
  RouteDelay route;
  for (int i = 0; i < answers; ++i) route.answered(delay);
  return route;
}

}  // namespace

TEST_CASE("on an unknown route the first timeout is the configured one", "[runtime][fetch]") {
  CHECK(RouteDelay().timeout(usual, 1) == usual.first);
  CHECK(RouteDelay().timeout(usual, 2) == 2 * usual.first);
  CHECK(RouteDelay().timeout(usual, 200) == usual.most);
}

TEST_CASE("the 99th percentile of delays is known to half a power of two, from above",
          "[runtime][fetch]") {
  for (Nanoseconds delay = microseconds(1); delay < seconds(60); delay = delay * 5 / 3) {
    const Nanoseconds p99 = after(10, delay).p99();
    CHECK(p99 > delay);
    CHECK(p99 <= 2 * delay + microseconds(1));
    if (delay > microseconds(2)) CHECK(p99 <= delay * 3 / 2 + microseconds(1));
  }
}

TEST_CASE("one slow answer in 100 is ignored, and two are not", "[runtime][fetch]") {
  RouteDelay route = after(198, milliseconds(1));
  route.answered(seconds(1));
  CHECK(route.p99() < milliseconds(2));
  route.answered(seconds(1));
  CHECK(route.p99() < milliseconds(2));
  route.answered(seconds(1));
  CHECK(route.p99() > seconds(1));
}

TEST_CASE("the timeout is three times the 99th percentile, within its limits", "[runtime][fetch]") {
  CHECK(after(10, microseconds(100)).timeout(usual, 1) == usual.floor);
  const RouteDelay route = after(10, milliseconds(100));
  CHECK(route.timeout(usual, 1) == 3 * route.p99());
  CHECK(route.timeout(usual, 2) == 6 * route.p99());
  CHECK(after(10, seconds(10)).timeout(usual, 1) == usual.most);
}

TEST_CASE("a route that has become slow keeps its doubled timeout until it answers in time",
          "[runtime][fetch]") {
  RouteDelay route = after(10, milliseconds(100));
  const Nanoseconds before = route.timeout(usual, 1);
  route.timed_out(seconds(1), seconds(2));
  CHECK(route.timeout(usual, 1) == 2 * before);
  route.timed_out(seconds(1), seconds(2));  // sent before that was known
  CHECK(route.timeout(usual, 1) == 2 * before);
  route.timed_out(seconds(2), seconds(3));
  CHECK(route.timeout(usual, 1) == 4 * before);
  route.answered(milliseconds(100));
  CHECK(route.timeout(usual, 1) == before);
}

TEST_CASE("a route that has become fast is learnt again", "[runtime][fetch]") {
  RouteDelay route = after(100, seconds(1));
  for (int i = 0; i < 5000; ++i) route.answered(milliseconds(1));
  CHECK(route.p99() < milliseconds(2));
}
