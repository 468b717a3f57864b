#include "runtime/fetch/fetcher.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "tests/unit/runtime/fetch/fetch_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId a{0}, b{1}, c{2};
constexpr size_t small = 1000;     // sent in one frame
constexpr size_t large = 300'000;  // sent in five frames

/// Fetches an object at the first node, and runs until the result.
Got fetch(FetchCluster& cluster, uint32_t object) {
  CacheRead reading{cluster[0], object};
  cluster[0].start(reading.body());
  cluster.until([&] { return reading.done; });
  if (reading.got.how == Got::How::resident) CHECK(reading.number == object);
  return reading.got;
}

/// Replaces the object's bytes by others of the same length.
void spoil(MapStore& store, const Objects& objects, uint32_t object) {
  store.held[objects.id(object).value] = share(pattern(objects.places[object].wire_bytes, 99));
}

/// Nothing in flight, nothing reserved, no timer but harmless ones.
void check_at_rest(FetchNode& node) {
  CHECK(node.fetcher.counters().receive_bytes_held == 0);
  CHECK(node.timers.set_now() == 0);
  CHECK(node.fibers.live() == 0);
}

}  // namespace

TEST_CASE("objects of one piece and of several come from their holder, whole", "[runtime][fetch]") {
  Objects objects;
  objects.add(small, {b});
  objects.add(large, {b});
  FetchCluster cluster(2, objects);
  for (const uint32_t object : {0u, 1u}) CHECK(fetch(cluster, object).how == Got::How::resident);
  const auto& counted = cluster[0].fetcher.counters();
  CHECK(counted.fetches == 2);
  CHECK(counted.retries == 0);
  CHECK(counted.bytes_in == small + large);
  CHECK(cluster[1].server.counters().served == 2);
  CHECK(cluster[1].server.counters().bytes_out == small + large);
  CHECK(cluster[0].fetcher.delay(1).count() == 2);
  cluster.run(milliseconds(10), milliseconds(1));
  check_at_rest(cluster[0]);
}

TEST_CASE("a holder without the object is asked once, then the replica", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b, c});
  FetchCluster cluster(3, objects);
  cluster[1].store.held.clear();
  CHECK(fetch(cluster, object).how == Got::How::resident);
  CHECK(cluster[0].fetcher.counters().not_here == 1);
  CHECK(cluster[0].fetcher.counters().timeouts == 0);
  CHECK(cluster[1].server.counters().refused == 1);
  CHECK(cluster[2].server.counters().served == 1);
}

TEST_CASE("the nearest holder is asked first if distances are known, then the others",
          "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {c, b});
  FetchSetup setup;
  setup.fetch.hops = {0, 1, 2};
  FetchCluster near(3, objects, setup);
  CHECK(fetch(near, object).how == Got::How::resident);
  CHECK(near[0].fetcher.counters().retries == 0);
  CHECK(near[1].server.counters().served == 1);
  CHECK(near[1].server.counters().intercepted == 0);
  FetchCluster gone(3, objects, setup);
  gone[1].store.held.clear();
  CHECK(fetch(gone, object).how == Got::How::resident);
  CHECK(gone[1].server.counters().refused == 1);
  CHECK(gone[2].server.counters().served == 1);
}

TEST_CASE("a lost holder costs no time if a replica is reachable", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {c, b});
  FetchCluster cluster(3, objects);
  cluster[2].network.say_bye();
  cluster.stop(2);
  cluster.run(milliseconds(100));
  CHECK(fetch(cluster, object).how == Got::How::resident);
  CHECK(cluster[0].fetcher.counters().timeouts == 0);
  CHECK(cluster[1].server.counters().served == 1);
}

TEST_CASE("a silent holder is asked the configured number of times, with growing timeouts",
          "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b, c});
  FetchSetup setup;
  setup.fetch.tries = 3;
  FetchCluster cluster(3, objects, setup);
  std::vector<Nanoseconds> asked;
  // Requests arrive at b, which has lost the object and does not answer.
  cluster[1].store.held.clear();
  cluster[1].on_deliver = [&](const Delivery& d) {
    if (!std::holds_alternative<FetchObject>(d.message)) return;
    asked.push_back(cluster.clock.now());
    CHECK(std::get<FetchObject>(d.message).attempt == asked.size());
    CHECK(std::get<FetchObject>(d.message).budget_us >= 1'000'000u << (asked.size() - 1));
  };
  cluster[1].mute = true;
  CHECK(fetch(cluster, object).how == Got::How::resident);
  REQUIRE(asked.size() == 3);
  CHECK(asked[1] - asked[0] >= seconds(1));
  CHECK(asked[2] - asked[1] >= seconds(2));
  CHECK(cluster[0].fetcher.counters().timeouts == 3);
  CHECK(cluster[0].fetcher.counters().retries == 3);
  CHECK(cluster[2].server.counters().served == 1);
}

TEST_CASE("a node's own store is the last resort, or the first if it is a holder",
          "[runtime][fetch]") {
  Objects objects;
  const uint32_t elsewhere = objects.add(small, {b});
  const uint32_t own = objects.add(small, {a, b});
  FetchCluster cluster(2, objects);
  cluster[1].store.held.clear();
  cluster.give(a, objects, objects.id(elsewhere));
  CHECK(fetch(cluster, own).how == Got::How::resident);
  CHECK(cluster[0].fetcher.counters().not_here == 0);
  CHECK(fetch(cluster, elsewhere).how == Got::How::resident);
  CHECK(cluster[0].fetcher.counters().not_here == 1);
  CHECK(cluster[0].fetcher.delay(0).count() == 2);
}

TEST_CASE("when all holders refuse, every waiter is told, and may ask again", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b, c});
  FetchCluster cluster(3, objects);
  const auto held = cluster[2].store.held;
  cluster[1].store.held.clear();
  cluster[2].store.held.clear();
  std::vector<CacheRead> readings(10, CacheRead{cluster[0], object});
  for (CacheRead& reading : readings) cluster[0].start(reading.body());
  cluster.until([&] { return cluster[0].fibers.live() == 0; });
  for (const CacheRead& reading : readings) CHECK(reading.got.how == Got::How::unobtainable);
  CHECK(cluster[0].fetcher.counters().unobtainable == 1);
  check_at_rest(cluster[0]);

  cluster[2].store.held = held;
  CHECK(fetch(cluster, object).how == Got::How::resident);
}

TEST_CASE("an object whose holders are all gone is unobtainable after a bounded time",
          "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b, c});
  FetchCluster cluster(3, objects);
  cluster.stop(1);
  cluster.stop(2);
  const Nanoseconds before = cluster.clock.now();
  CHECK(fetch(cluster, object).how == Got::How::unobtainable);
  // Four tries each; the waits are 1, 2, 4 and 5 s, and up to a quarter more.
  CHECK(cluster.clock.now() - before <= 2 * seconds(15));
  check_at_rest(cluster[0]);
}

TEST_CASE("a fetch succeeds despite loss, duplication, reordering and corruption",
          "[runtime][fetch]") {
  Objects objects;
  for (int i = 0; i < 40; ++i) objects.add(i % 4 == 0 ? large : small, {b, c});
  FetchCluster cluster(3, objects);
  cluster.net.faults = {.loss = 0.05f, .twice = 0.05f, .reorder = 0.05f, .flipped_bit = 0.01f};
  std::vector<CacheRead> readings;
  for (uint32_t i = 0; i < 40; ++i) readings.push_back({cluster[0], i});
  for (size_t first = 0; first < 40; first += 8) {
    for (size_t i = first; i < first + 8; ++i) cluster[0].start(readings[i].body());
    cluster.until([&] { return cluster[0].fibers.live() == 0; });
  }
  for (const CacheRead& reading : readings) {
    CHECK(reading.got.how == Got::How::resident);
    CHECK(reading.number == reading.object);
  }
  CHECK(cluster[0].fetcher.counters().retries > 0);
  cluster.net.faults = {};
  cluster.run(seconds(20));
  check_at_rest(cluster[0]);
}

TEST_CASE("a late or duplicate answer is dropped", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b, c});
  FetchCluster cluster(3, objects);
  std::vector<MessageId> questions;
  cluster[1].on_deliver = [&](const Delivery& d) { questions.push_back(d.id); };
  CHECK(fetch(cluster, object).how == Got::How::resident);
  REQUIRE(questions.size() == 1);
  const auto say = [&](const Message& answer, SharedBytes bytes) {
    cluster[1].say(a, questions[0], answer, std::move(bytes));
    cluster.run(milliseconds(20), milliseconds(1));
  };
  say(ObjectFound{objects.id(object), b}, objects.bytes[object]);
  say(ObjectNotHere{objects.id(object), b}, {});
  CHECK(cluster[0].fetcher.counters().late == 2);
  say(ObjectFound{objects.id(object), b}, share(pattern(large)));  // finds no room
  CHECK(cluster[0].network.counters().dropped_unexpected == 5);
  CHECK(cluster[0].builder.built.size() == 1);
}

TEST_CASE("a late answer of an abandoned holder is accepted while another is asked",
          "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b, c});
  FetchSetup setup;
  setup.fetch.tries = 1;
  FetchCluster cluster(3, objects, setup);
  cluster[1].mute = cluster[2].mute = true;
  cluster[1].store.held.clear();  // so that b forwards requests to c
  std::vector<MessageId> questions;
  cluster[1].on_deliver = [&](const Delivery& d) { questions.push_back(d.id); };
  CacheRead reading{cluster[0], object};
  cluster[0].start(reading.body());
  cluster.run(milliseconds(1500));
  REQUIRE(questions.size() == 1);
  cluster[1].say(a, questions[0], ObjectNotHere{objects.id(object), b});
  cluster.run(milliseconds(10), milliseconds(1));
  CHECK_FALSE(reading.done);  // b's answer no longer counts
  cluster[1].say(a, questions[0], ObjectFound{objects.id(object), b}, objects.bytes[object]);
  cluster.run(milliseconds(10), milliseconds(1));
  CHECK(reading.got.how == Got::How::resident);
}

TEST_CASE("wrong bytes are counted, dropped, and requested elsewhere", "[runtime][fetch]") {
  for (const size_t size : {small, large}) {
    Objects objects;
    const uint32_t object = objects.add(size, {b, c});
    FetchCluster cluster(3, objects);
    spoil(cluster[1].store, objects, object);
    cluster[1].intercepts = false;
    // it answers twice: the late answer is dropped
    cluster[1].on_deliver = [&](const Delivery& d) {
      cluster[1].say(d.source, d.id, ObjectFound{objects.id(object), b},
                     cluster[1].store.find(objects.id(object)));
    };
    CHECK(fetch(cluster, object).how == Got::How::resident);
    CHECK(cluster[0].fetcher.counters().wrong_hash == 1);
    CHECK(cluster[1].server.counters().served == 1);
    CHECK(cluster[2].server.counters().served == 1);
  }
}

TEST_CASE("an object of which all holders have wrong bytes is unobtainable", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b});
  FetchCluster cluster(2, objects);
  spoil(cluster[1].store, objects, object);
  spoil(cluster[0].store, objects, object);
  CHECK(fetch(cluster, object).how == Got::How::unobtainable);
  CHECK(cluster[0].fetcher.counters().wrong_hash == 5);  // four tries and the own store
  check_at_rest(cluster[0]);
}

TEST_CASE("an answer that has begun to arrive is awaited", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(40 * large, {b});
  FetchSetup setup;
  setup.fetch.timeouts.first = milliseconds(2);
  FetchCluster cluster(2, objects, setup);
  const Nanoseconds before = cluster.clock.now();
  CHECK(fetch(cluster, object).how == Got::How::resident);
  CHECK(cluster.clock.now() - before > milliseconds(4));
  CHECK(cluster[0].fetcher.counters().timeouts == 0);
}

TEST_CASE("a fetch that ends with some pieces received releases their room", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(40 * large, {b});
  FetchCluster cluster(2, objects, {},
                       [](NetConfig& config) { config.assembly_patience = seconds(60); });
  CacheRead reading{cluster[0], object};
  cluster[0].start(reading.body());
  cluster.turn();
  cluster.stop(1);
  cluster.until([&] { return reading.done; });
  CHECK(reading.got.how == Got::How::unobtainable);
  cluster.run(cluster[0].config.assembly_patience + seconds(1));
  CHECK(cluster[0].network.counters().bytes_received > large / 2);
  CHECK(cluster[0].network.counters().assemblies_abandoned == 0);
  check_at_rest(cluster[0]);
}

TEST_CASE("a reply longer than its object gets no room", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(large, {b});
  FetchCluster cluster(2, objects);
  cluster[1].store.held[objects.id(object).value] = share(pattern(4 * large));
  CHECK(fetch(cluster, object).how == Got::How::unobtainable);
  CHECK(cluster[0].fetcher.counters().bytes_in == 0);
  CHECK(cluster[0].network.counters().dropped_unexpected > 0);
}

TEST_CASE("a node on the way that has the object answers for the holder", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(large, {c});
  FetchCluster cluster(3, objects);
  cluster.give(b, objects, objects.id(object));
  CHECK(fetch(cluster, object).how == Got::How::resident);
  CHECK(cluster[1].server.counters().intercepted == 1);
  CHECK(cluster[2].server.counters().served == 0);
  CHECK(cluster[0].fetcher.delay(1).count() == 1);
}

TEST_CASE("fetches beyond the room for their bytes wait their turn", "[runtime][fetch]") {
  Objects objects;
  for (int i = 0; i < 20; ++i) objects.add(large, {b});
  FetchSetup setup;
  setup.fetch.receive_bytes = 3 * large;
  setup.fibers = 20;
  FetchCluster cluster(2, objects, setup);
  std::vector<CacheRead> readings;
  for (uint32_t i = 0; i < 20; ++i) readings.push_back({cluster[0], i});
  for (CacheRead& reading : readings) cluster[0].start(reading.body());
  uint64_t most = 0;
  cluster.until([&] {
    most = std::max(most, cluster[0].fetcher.counters().receive_bytes_held);
    return cluster[0].fibers.live() == 0;
  });
  CHECK(most == 3 * large);
  for (const CacheRead& reading : readings) CHECK(reading.got.how == Got::How::resident);
}

TEST_CASE("a full outbox delays requests without using up a try", "[runtime][fetch]") {
  Objects objects;
  for (int i = 0; i < 50; ++i) objects.add(small, {b});
  FetchSetup setup;
  setup.fibers = 50;
  setup.fetch.tries = 1;
  FetchCluster cluster(2, objects, setup, [](NetConfig& config) { config.outbox_messages = 2; });
  std::vector<CacheRead> readings;
  for (uint32_t i = 0; i < 50; ++i) readings.push_back({cluster[0], i});
  for (CacheRead& reading : readings) cluster[0].start(reading.body());
  cluster.until([&] { return cluster[0].fibers.live() == 0; });
  CHECK(cluster[0].fetcher.counters().outbox_full > 0);
  for (const CacheRead& reading : readings) CHECK(reading.got.how == Got::How::resident);
}

TEST_CASE("a fetcher that ends in the middle of a fetch leaves nothing behind",
          "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(40 * large, {b});
  FetchCluster cluster(2, objects);
  cluster[0].cache.prefetch(std::array{object});
  for (int i = 0; i < 3; ++i) cluster.turn();
  CHECK(cluster[0].cache.state(object) == ObjectState::requested);
  cluster.stop(0);  // some pieces have arrived, and timers are set
  cluster.run(seconds(1));
  CHECK(cluster[1].server.counters().served == 1);
}

TEST_CASE("the same seed gives the same fetches at the same times", "[runtime][fetch]") {
  const auto run = [](uint64_t seed) {
    Objects objects;
    for (int i = 0; i < 12; ++i) objects.add(i % 3 == 0 ? large : small, {c, b});
    FetchSetup setup;
    setup.seed = seed;
    FetchCluster cluster(3, objects, setup);
    cluster.net.faults = {.loss = 0.1f, .reorder = 0.1f};
    std::vector<std::pair<Nanoseconds, uint32_t>> built;
    cluster[0].builder.on_build = [&](uint32_t object) {
      built.emplace_back(cluster.clock.now(), object);
    };
    std::vector<CacheRead> readings;
    for (uint32_t i = 0; i < 12; ++i) readings.push_back({cluster[0], i});
    for (CacheRead& reading : readings) cluster[0].start(reading.body());
    cluster.until([&] { return cluster[0].fibers.live() == 0; });
    return built;
  };
  CHECK(run(7) == run(7));
  CHECK(run(7) != run(8));
}

TEST_CASE("counters can be read by name, and memory is in the plan", "[runtime][fetch]") {
  Objects objects;
  const uint32_t object = objects.add(small, {b});
  const FetchSetup setup;
  FetchCluster cluster(2, objects, setup);
  Metrics metrics("0");
  cluster[0].server.add_metrics(metrics);
  CHECK(fetch(cluster, object).how == Got::How::resident);
  REQUIRE(metrics.publish());
  const std::string text = Metrics::published({&metrics});
  const auto says = [&](const std::string& line) { return text.find(line) != std::string::npos; };
  CHECK(says("luxodus_fetch_in_bytes_total{node=\"0\"} 1000\n"));
  CHECK(says("luxodus_cache_misses_total{node=\"0\"} 1\n"));
  CHECK(says("luxodus_objects_resident_bytes{node=\"0\"} 100\n"));

  MemoryPlan plan;
  PartServer::plan_memory(plan, setup.fetch, setup.cache, objects.places.size());
  CHECK(plan.total_bytes() > setup.fetch.receive_bytes + setup.cache.budget_bytes);
}

TEST_CASE("objects that the configuration cannot fetch are rejected at the start",
          "[runtime][fetch]") {
  FetchSetup setup;
  setup.fetch.receive_bytes = 100;
  Objects too_long;
  too_long.add(101, {b});
  CHECK_THROWS_AS(FetchCluster(2, too_long, setup), std::invalid_argument);
  Objects too_many;
  too_many.add(10, std::vector<NodeId>(limits::holders + 1, a));
  CHECK_THROWS_AS(FetchCluster(2, too_many), std::invalid_argument);
  Objects empty;
  empty.places.push_back({{1}, 0, {a}});
  empty.bytes.push_back({});
  CHECK_THROWS_AS(FetchCluster(2, empty), std::invalid_argument);
}
