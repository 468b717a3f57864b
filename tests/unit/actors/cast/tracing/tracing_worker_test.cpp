#include "actors/cast/tracing/tracing_worker.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

TEST_CASE("flushes that cost little come as often as configured", "[lease client]") {
  CHECK(flush_interval(seconds(5), milliseconds(20), seconds(120)) == seconds(5));
}

TEST_CASE("flushes that cost much come seldom, so that they take a fiftieth of the time",
          "[lease client]") {
  CHECK(flush_interval(seconds(5), milliseconds(300), seconds(120)) == seconds(15));
}

TEST_CASE("merged batches are flushed long before their leases end, whatever that costs",
          "[lease client]") {
  CHECK(flush_interval(seconds(5), seconds(10), seconds(120)) == seconds(30));
  CHECK(flush_interval(seconds(5), 0, seconds(8)) == seconds(2));
}
