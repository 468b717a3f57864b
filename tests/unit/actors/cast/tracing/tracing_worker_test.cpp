#include "actors/cast/tracing/tracing_worker.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

TEST_CASE("cheap flushes are sent as often as configured", "[lease client]") {
  CHECK(flush_interval(seconds(5), milliseconds(20), seconds(120)) == seconds(5));
}

TEST_CASE("expensive flushes are rare enough to take a fiftieth of the time", "[lease client]") {
  CHECK(flush_interval(seconds(5), milliseconds(300), seconds(120)) == seconds(15));
}

TEST_CASE("merged batches are flushed long before their leases end, at any cost",
          "[lease client]") {
  CHECK(flush_interval(seconds(5), seconds(10), seconds(120)) == seconds(30));
  CHECK(flush_interval(seconds(5), 0, seconds(8)) == seconds(2));
}
