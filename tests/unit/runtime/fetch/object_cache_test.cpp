#include "runtime/fetch/object_cache.hpp"

#include <array>
#include <numeric>
#include <stdexcept>

#include "tests/unit/runtime/fetch/fetch_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId here{0};

/// Objects that the test's only node holds itself, so that their bytes are one turn away.
Objects own_objects(size_t count) {
  Objects objects;
  for (size_t i = 0; i < count; ++i) objects.add(64, {here});
  return objects;
}

/// Room for `count` unpinned objects of 100 bytes, beside one build.
FetchSetup room_for_objects(size_t count) {
  FetchSetup setup;
  setup.cache = {.budget_bytes = 100 * (count + 1), .largest_build_bytes = 100, .pinned_share = 0};
  return setup;
}

std::vector<uint32_t> resident(FetchNode& node, uint32_t objects) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < objects; ++i)
    if (node.cache.state(i) == ObjectState::resident) out.push_back(i);
  return out;
}

void bring(FetchCluster& cluster, std::vector<uint32_t> objects) {
  for (const uint32_t object : objects) {
    cluster[0].cache.prefetch(std::array{object});
    cluster.run(milliseconds(20), milliseconds(1));
  }
}

}  // namespace

TEST_CASE("an object goes from absent to resident and back as in the diagram", "[runtime][fetch]") {
  const Objects objects = own_objects(3);
  FetchCluster cluster(1, objects, room_for_objects(1));
  FetchNode& node = cluster[0];
  node.builder.at_once = false;
  const auto asked = [&](uint32_t object) { node.cache.prefetch(std::array{object}); };
  const auto passes = [&] { cluster.run(milliseconds(3), milliseconds(1)); };
  struct Row {
    const char* event;
    std::function<void()> happens;
    ObjectState then;
  };
  const auto held = node.store.held;
  const Row table[] = {
      {"nothing", [] {}, ObjectState::absent},
      {"it is asked for", [&] { asked(0); }, ObjectState::requested},
      {"it is asked for again", [&] { asked(0); }, ObjectState::requested},
      {"its bytes come", passes, ObjectState::building},
      {"it is asked for a third time", [&] { asked(0); }, ObjectState::building},
      {"it is built", [&] { node.builder.answer(); }, ObjectState::building},
      {"it comes in", passes, ObjectState::resident},
      {"it is asked for when it is there", [&] { asked(0); }, ObjectState::resident},
      {"another is built", [&] { asked(1), passes(), node.builder.answer(); },
       ObjectState::resident},
      {"the other comes in", passes, ObjectState::absent},
      {"nobody has it", [&] { node.store.held.clear(), asked(0); }, ObjectState::requested},
      {"all have said so", passes, ObjectState::absent},
      {"somebody has it again", [&] { node.store.held = held, asked(0), passes(); },
       ObjectState::building},
      {"it cannot be built", [&] { node.builder.problem = true, node.builder.answer(), passes(); },
       ObjectState::absent},
  };
  for (const Row& row : table) {
    INFO(row.event);
    row.happens();
    CHECK(node.cache.state(0) == row.then);
  }
  CHECK(node.cache.counters().builds == 3);
  CHECK(node.cache.counters().build_failures == 1);
}

TEST_CASE("however many fibers want an object, it is fetched and built once", "[runtime][fetch]") {
  const Objects objects = own_objects(1);
  FetchSetup setup = room_for_objects(1);
  setup.fibers = 100;
  FetchCluster cluster(1, objects, setup);
  FetchNode& node = cluster[0];
  std::vector<CacheRead> readings(100, CacheRead{node, 0});
  for (CacheRead& reading : readings) node.start(reading.body());
  cluster.run(milliseconds(20), milliseconds(1));
  for (const CacheRead& reading : readings) CHECK(reading.got.how == Got::How::resident);
  CHECK(node.cache.counters().misses == 1);
  CHECK(node.cache.counters().joined == 99);
  CHECK(node.fetcher.counters().fetches == 1);
  CHECK(node.builder.built.size() == 1);
}

TEST_CASE("with room for one object thousands of fibers get every object that they visit",
          "[runtime][fetch]") {
  constexpr uint32_t count = 40;
  constexpr size_t fibers = 2000;
  constexpr uint32_t visits = 12;
  const Objects objects = own_objects(count);
  FetchSetup setup = room_for_objects(1);
  setup.fibers = fibers;
  FetchCluster cluster(1, objects, setup);
  FetchNode& node = cluster[0];
  struct Walker {
    FetchNode* node;
    uint32_t first;
    uint32_t reached = 0;
    void walk() {
      for (uint32_t i = 0; i < visits; ++i) {
        const uint32_t wanted = (first * 7 + i * i * 11 + i) % count;
        const Got got = node->cache.get(wanted);
        if (got.how != Got::How::resident) return;
        if (static_cast<const TestObject*>(got.object)->number == wanted) ++reached;
      }
    }
  };
  std::vector<Walker> walkers;
  for (uint32_t i = 0; i < fibers; ++i) walkers.push_back({&node, i});
  for (Walker& walker : walkers) node.start([&walker] { walker.walk(); });
  int max_alive = 0;
  node.builder.on_build = [&](uint32_t) { max_alive = std::max(max_alive, *node.builder.alive); };
  cluster.until([&] { return node.fibers.live() == 0; });
  for (const Walker& walker : walkers) REQUIRE(walker.reached == visits);
  CHECK(max_alive <= 1);
  // Fibers that wait for one object share its fetch: far fewer fetches than visits.
  CHECK(node.fetcher.counters().fetches < fibers * visits / 50);
}

TEST_CASE("an object stays until all its waiters have run, even if the next is ready",
          "[runtime][fetch]") {
  const Objects objects = own_objects(2);
  FetchCluster cluster(1, objects, room_for_objects(1));
  FetchNode& node = cluster[0];
  const auto without_fibers = [&] {
    for (int i = 0; i < 10; ++i) {
      node.timers.run_due(cluster.clock.now(), 256);
      node.network.poll(cluster.clock.now());
      cluster.clock.advance(milliseconds(1));
    }
  };
  std::vector<CacheRead> readings(3, CacheRead{node, 0});
  readings.push_back({node, 1});
  for (CacheRead& reading : readings) node.start(reading.body());
  node.run_fibers();  // all wait
  without_fibers();   // 0 has become resident, and 1 is built
  CHECK(node.builder.built == std::vector<uint32_t>{0, 1});
  CHECK(node.cache.state(0) == ObjectState::resident);
  for (int i = 0; i < 2; ++i) {
    node.fibers.run_next();
    without_fibers();
    CHECK(node.cache.state(0) == ObjectState::resident);
  }
  node.fibers.run_next();
  without_fibers();
  CHECK(node.cache.state(0) == ObjectState::absent);
  CHECK(node.cache.state(1) == ObjectState::resident);
  node.run_fibers();
  for (const CacheRead& reading : readings) CHECK(reading.number == reading.object);
}

TEST_CASE("the least recently used object is evicted", "[runtime][fetch]") {
  const Objects objects = own_objects(5);
  FetchCluster cluster(1, objects, room_for_objects(3));
  FetchNode& node = cluster[0];
  bring(cluster, {0, 1, 2});
  CHECK(node.cache.find(0) != nullptr);
  bring(cluster, {3});
  CHECK(resident(node, 5) == std::vector<uint32_t>{0, 2, 3});
  bring(cluster, {4});
  CHECK(resident(node, 5) == std::vector<uint32_t>{0, 3, 4});
  CHECK(node.cache.counters().evictions == 2);
  CHECK(*node.builder.alive == 3);
}

TEST_CASE("objects are charged their built size, and leave room for one build",
          "[runtime][fetch]") {
  const Objects objects = own_objects(4);
  FetchSetup setup;
  setup.cache = {.budget_bytes = 1000, .largest_build_bytes = 400, .pinned_share = 0};
  FetchCluster cluster(1, objects, setup);
  FetchNode& node = cluster[0];
  node.builder.charges = {{0, 100}, {1, 400}, {2, 100}, {3, 350}};
  bring(cluster, {0, 1, 2});
  CHECK(node.cache.counters().resident_bytes == 600);
  CHECK(node.cache.counters().evictions == 0);
  bring(cluster, {3});  // 350 over 600: both 0 and 1 must go
  CHECK(resident(node, 4) == std::vector<uint32_t>{2, 3});
  CHECK(node.cache.counters().resident_bytes == 450);
}

TEST_CASE("an object larger than planned is used all the same, alone, and counted",
          "[runtime][fetch]") {
  const Objects objects = own_objects(3);
  FetchCluster cluster(1, objects, room_for_objects(2));
  FetchNode& node = cluster[0];
  node.builder.charges = {{2, 5000}};
  bring(cluster, {0, 1, 2});
  CHECK(resident(node, 3) == std::vector<uint32_t>{2});
  CHECK(node.cache.counters().oversized == 1);
  bring(cluster, {0});
  CHECK(resident(node, 3) == std::vector<uint32_t>{0});
}

TEST_CASE("pinned objects stay, in order, as many as fit the pinned share", "[runtime][fetch]") {
  const Objects objects = own_objects(10);
  FetchSetup setup;
  setup.cache = {.budget_bytes = 600, .largest_build_bytes = 100, .pinned_share = 0.4};
  FetchCluster cluster(1, objects, setup);
  FetchNode& node = cluster[0];
  bring(cluster, {1});  // one of them is resident already
  node.cache.pin(std::array<uint32_t, 3>{0, 1, 2});
  cluster.run(milliseconds(20), milliseconds(1));
  CHECK(node.cache.counters().pinned_bytes == 200);
  CHECK(node.cache.counters().pins_refused == 1);
  CHECK(node.cache.pinned(0));
  CHECK(node.cache.pinned(1));
  bring(cluster, {3, 4, 5, 6, 7, 8, 9});
  CHECK(resident(node, 10) == std::vector<uint32_t>{0, 1, 7, 8, 9});
  CHECK(node.cache.counters().resident_bytes == 500);
}

TEST_CASE("a fiber cancelled while it waits is told so, and the others get their object",
          "[runtime][fetch]") {
  const Objects objects = own_objects(1);
  FetchCluster cluster(1, objects);
  FetchNode& node = cluster[0];
  CacheRead stays{node, 0}, goes{node, 0}, late{node, 0};
  node.start(stays.body());
  const FiberId going = node.start(goes.body());
  const FiberId too_late = node.start(late.body());
  node.run_fibers();
  node.fibers.cancel(going);
  node.run_fibers();
  CHECK(goes.got.how == Got::How::cancelled);
  node.builder.on_build = [&](uint32_t) { CHECK_FALSE(stays.done); };
  for (int i = 0; i < 5; ++i) {
    node.timers.run_due(cluster.clock.now(), 256);
    cluster.clock.advance(1);
  }
  REQUIRE(node.cache.state(0) == ObjectState::resident);
  node.fibers.cancel(too_late);  // it was woken before: the wake counts
  node.run_fibers();
  CHECK(stays.got.how == Got::How::resident);
  CHECK(late.got.how == Got::How::resident);
  CHECK(node.fibers.live() == 0);
}

TEST_CASE("a fetch without any waiter left ends like any other", "[runtime][fetch]") {
  const Objects objects = own_objects(2);
  FetchCluster cluster(1, objects, room_for_objects(1));
  FetchNode& node = cluster[0];
  CacheRead reading{node, 0};
  const FiberId id = node.start(reading.body());
  node.run_fibers();
  node.fibers.cancel(id);
  bring(cluster, {1});
  CHECK(reading.got.how == Got::How::cancelled);
  CHECK(resident(node, 2) == std::vector<uint32_t>{1});
  CHECK(node.fetcher.counters().receive_bytes_held == 0);
}

TEST_CASE("a failed build is reported to all waiters, and may be retried", "[runtime][fetch]") {
  const Objects objects = own_objects(1);
  FetchCluster cluster(1, objects);
  FetchNode& node = cluster[0];
  node.builder.problem = true;
  std::vector<CacheRead> readings(3, CacheRead{node, 0});
  for (CacheRead& reading : readings) node.start(reading.body());
  cluster.run(milliseconds(20), milliseconds(1));
  for (const CacheRead& reading : readings) {
    CHECK(reading.done);
    CHECK(reading.got.how == Got::How::unobtainable);
  }
  node.builder.problem = false;
  CacheRead again{node, 0};
  node.start(again.body());
  cluster.run(milliseconds(20), milliseconds(1));
  CHECK(again.got.how == Got::How::resident);
}

TEST_CASE("a waiting fiber has the next objects prefetched, and gets its own first",
          "[runtime][fetch]") {
  const Objects objects = own_objects(4);
  FetchCluster cluster(1, objects);
  FetchNode& node = cluster[0];
  Got got;
  node.start([&] { got = node.cache.get(2, false, std::array<uint32_t, 2>{0, 3}); });
  cluster.run(milliseconds(20), milliseconds(1));
  CHECK(got.how == Got::How::resident);
  CHECK(node.builder.built == std::vector<uint32_t>{2, 0, 3});
  CHECK(node.cache.counters().misses == 1);
  // Without a wait nothing is prefetched.
  node.start([&] { got = node.cache.get(2, false, std::array<uint32_t, 1>{1}); });
  cluster.run(milliseconds(20), milliseconds(1));
  CHECK(node.cache.state(1) == ObjectState::absent);
}

TEST_CASE("while fibers run, the builder has at most one object", "[runtime][fetch]") {
  const Objects objects = own_objects(4);
  FetchCluster cluster(1, objects);
  FetchNode& node = cluster[0];
  node.builder.at_once = false;
  node.builder.on_build = [&](uint32_t) { CHECK_FALSE(node.builder.pending()); };
  std::vector<uint32_t> all(4);
  std::iota(all.begin(), all.end(), 0);
  node.cache.prefetch(all);
  for (uint32_t i = 0; i < 4; ++i) {
    cluster.run(milliseconds(10), milliseconds(1));
    CHECK(node.builder.built.size() == i + 1);
    CHECK(node.cache.building());
    node.builder.answer();
  }
  cluster.run(milliseconds(10), milliseconds(1));
  CHECK(resident(node, 4) == all);
}

TEST_CASE("a budget without room for pins, an object and a build is rejected", "[runtime][fetch]") {
  const Objects objects = own_objects(1);
  FetchSetup setup;
  setup.cache = {.budget_bytes = 398, .largest_build_bytes = 100, .pinned_share = 0.5};
  CHECK_THROWS_AS(FetchCluster(1, objects, setup), std::invalid_argument);
  setup.cache.budget_bytes = 400;
  CHECK_NOTHROW(FetchCluster(1, objects, setup));
}
