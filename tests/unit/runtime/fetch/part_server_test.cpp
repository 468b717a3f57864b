// How a node serves others' requests. Its own fetches are in fetcher_test.cpp.
#include "runtime/fetch/part_server.hpp"

#include <functional>

#include "tests/unit/runtime/fetch/fetch_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId b{1}, c{2};

Got::How fetch(FetchCluster& cluster, size_t node, uint32_t object) {
  CacheRead reading{cluster[node], object};
  cluster[node].start(reading.body());
  cluster.until([&] { return reading.done; });
  return reading.got.how;
}

/// Fifty fibers get their objects from a holder whose outbox takes one message at a time; `look`
/// observes it.
void crowd(FetchSetup setup, const std::function<void(FetchCluster&)>& look) {
  Objects objects;
  for (int i = 0; i < 50; ++i) objects.add(1000, {b});
  setup.fibers = 50;
  FetchCluster cluster(2, objects, setup, [](NetConfig& config) {
    if (config.self == b) config.outbox_messages = 1;
  });
  std::vector<CacheRead> readings;
  for (uint32_t i = 0; i < 50; ++i) readings.push_back({cluster[0], i});
  for (CacheRead& reading : readings) cluster[0].start(reading.body());
  cluster.until([&] { return cluster[0].fibers.live() == 0; });
  for (const CacheRead& reading : readings) CHECK(reading.got.how == Got::How::resident);
  look(cluster);
}

}  // namespace

TEST_CASE("a node serves objects from its cache, even if it is no holder", "[runtime][fetch]") {
  for (const size_t size : {1000, 200'000}) {
    Objects objects;
    const uint32_t object = objects.add(size, {c});
    FetchCluster cluster(3, objects);
    REQUIRE(fetch(cluster, 1, object) == Got::How::resident);
    REQUIRE(cluster[2].server.counters().served == 1);
    CHECK(fetch(cluster, 0, object) == Got::How::resident);
    CHECK(cluster[2].server.counters().served == 1);
    CHECK(cluster[1].server.counters().from_cache == 1);
    CHECK(cluster[1].server.counters().intercepted == 1);
    CHECK(cluster[0].fetcher.delay(1).count() == 1);
    CHECK(cluster[0].fetcher.counters().wrong_hash == 0);
  }
}

TEST_CASE("a node that does not share its cache forwards requests", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(1000, {c});
  FetchSetup setup;
  setup.fetch.shares_cache = false;
  FetchCluster cluster(3, objects, setup);
  REQUIRE(fetch(cluster, 1, object) == Got::How::resident);
  CHECK(fetch(cluster, 0, object) == Got::How::resident);
  CHECK(cluster[1].server.counters().from_cache == 0);
  CHECK(cluster[2].server.counters().served == 2);
}

TEST_CASE("a request from another node does not protect an object from eviction",
          "[runtime][fetch]") {
  Objects objects;
  for (int i = 0; i < 3; ++i) objects.add(1000, {c});
  FetchSetup setup;
  setup.cache = {.budget_bytes = 300, .largest_build_bytes = 100, .pinned_share = 0};  // two of 100
  FetchCluster cluster(3, objects, setup);
  REQUIRE(fetch(cluster, 1, 0) == Got::How::resident);
  REQUIRE(fetch(cluster, 1, 1) == Got::How::resident);
  REQUIRE(fetch(cluster, 0, 0) == Got::How::resident);
  REQUIRE(cluster[1].server.counters().from_cache == 1);
  REQUIRE(fetch(cluster, 1, 2) == Got::How::resident);
  CHECK(cluster[1].cache.peek(0) == nullptr);
  CHECK(cluster[1].cache.peek(1) != nullptr);
}

TEST_CASE("requests without room for an answer wait, and are answered in order",
          "[runtime][fetch]") {
  FetchSetup setup;
  setup.fetch.tries = 1;
  crowd(setup, [](FetchCluster& cluster) {
    CHECK(cluster[1].server.counters().waited > 0);
    CHECK(cluster[1].server.counters().dropped == 0);
    CHECK(cluster[0].fetcher.counters().timeouts == 0);
  });
}

TEST_CASE("requests beyond those that may wait are dropped, counted, and retried",
          "[runtime][fetch]") {
  FetchSetup setup;
  setup.fetch.requests = 4;
  crowd(setup, [](FetchCluster& cluster) {
    CHECK(cluster[1].server.counters().dropped > 0);
    CHECK(cluster[0].fetcher.counters().timeouts > 0);
  });
}

TEST_CASE("requests and answers go through the mailbox, and other messages do not",
          "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(1000, {b});
  FetchCluster cluster(2, objects);
  cluster[0].say(b, cluster[0].network.next_id(), RequestLease{1});
  REQUIRE(fetch(cluster, 0, object) == Got::How::resident);
  cluster.run(milliseconds(20));
  CHECK(cluster[1].system.counters().not_accepted == 1);
  Metrics metrics("1");
  cluster[1].system.add_metrics(metrics);
  REQUIRE(metrics.publish());
  CHECK(Metrics::published({&metrics})
            .find("luxodus_mailbox_taken_total{node=\"1\",actor=\"part_server\"} 1\n") !=
        std::string::npos);
}

TEST_CASE("a part server that has failed answers nobody", "[runtime][fetch]") {
  struct Listener final : FailureListener {
    void on_failure(Supervised&, const std::exception_ptr&) noexcept override { ++failures; }
    int failures = 0;
  } listener;
  Objects objects;
  const uint32_t object = objects.add(1000, {b, c});
  FetchSetup setup;
  setup.fetch.tries = 1;
  FetchCluster cluster(3, objects, setup);
  cluster[1].server.supervise_by(listener);
  cluster[1].server.fail_next();
  CHECK(fetch(cluster, 0, object) == Got::How::resident);
  CHECK(listener.failures == 1);
  CHECK(cluster[1].server.counters().served == 0);
  CHECK(cluster[2].server.counters().served == 1);
}
