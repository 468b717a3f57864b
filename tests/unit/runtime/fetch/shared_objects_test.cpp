// Nodes of one process that share built objects: one build, one copy, and nothing lost when one of
// them evicts it.
#include "runtime/fetch/shared_objects.hpp"

#include <array>

#include "tests/unit/runtime/fetch/fetch_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId first{0};

/// Two nodes of one process; the first holds all bytes. Each has room for two objects.
struct Pair {
  explicit Pair(size_t count) : shared(count) {
    for (size_t i = 0; i < count; ++i) objects.add(64, {first});
    setup.cache = {.budget_bytes = 300, .largest_build_bytes = 100, .pinned_share = 0};
    setup.cache.shared = &shared;
  }
  SharedObjects shared;
  Objects objects;
  FetchSetup setup;
};

void bring_shared(FetchCluster& cluster, size_t node, uint32_t object) {
  cluster[node].cache.prefetch(std::array{object});
  cluster.run(milliseconds(20), milliseconds(1));
}

}  // namespace

TEST_CASE("an object resident at another node of the process is neither fetched nor built again",
          "[runtime][fetch]") {
  Pair pair(3);
  FetchCluster cluster(2, pair.objects, pair.setup);
  bring_shared(cluster, 0, 1);
  bring_shared(cluster, 1, 1);
  CHECK(cluster[0].cache.state(1) == ObjectState::resident);
  CHECK(cluster[1].cache.state(1) == ObjectState::resident);
  CHECK(cluster[0].cache.find(1) == cluster[1].cache.find(1));
  CHECK(cluster[0].cache.counters().builds == 1);
  CHECK(cluster[1].cache.counters().builds == 0);
  CHECK(cluster[1].cache.counters().builds_saved == 1);
  CHECK(cluster[1].fetcher.counters().fetches == 0);
  // Each is charged in full.
  CHECK(cluster[0].cache.counters().resident_bytes == 100);
  CHECK(cluster[1].cache.counters().resident_bytes == 100);
}

TEST_CASE("a shared object lives until the last node has released it", "[runtime][fetch]") {
  Pair pair(5);
  FetchCluster cluster(2, pair.objects, pair.setup);
  bring_shared(cluster, 0, 0);
  bring_shared(cluster, 1, 0);
  for (const uint32_t other : {1u, 2u}) bring_shared(cluster, 0, other);
  CHECK(cluster[0].cache.state(0) == ObjectState::absent);
  CHECK(*cluster[0].builder.alive == 3);
  REQUIRE(cluster[1].cache.find(0) != nullptr);
  CHECK(static_cast<const TestObject*>(cluster[1].cache.find(0))->number == 0);
  bring_shared(cluster, 0, 0);  // and is taken again
  CHECK(cluster[0].cache.counters().builds == 3);
  CHECK(cluster[0].cache.counters().builds_saved == 1);
  for (const size_t node : {0u, 1u})
    for (const uint32_t other : {3u, 4u}) bring_shared(cluster, node, other);
  CHECK(pair.shared.find(0) == nullptr);
}

TEST_CASE("an object released before its turn is fetched after all", "[runtime][fetch]") {
  Pair pair(3);
  FetchCluster cluster(2, pair.objects, pair.setup);
  auto elsewhere =
      pair.shared.add(2, std::make_shared<TestObject>(2, 100, std::make_shared<int>(0)));
  cluster[1].cache.prefetch(std::array{2u});
  CHECK(cluster[1].cache.state(2) == ObjectState::building);
  elsewhere.reset();
  cluster.run(milliseconds(20), milliseconds(1));
  CHECK(cluster[1].cache.state(2) == ObjectState::resident);
  CHECK(cluster[1].cache.counters().builds == 1);
  CHECK(cluster[1].cache.counters().builds_saved == 0);
  CHECK(cluster[1].fetcher.counters().fetches == 1);
  CHECK(cluster[1].fetcher.counters().receive_bytes_held == 0);
}

TEST_CASE("if two nodes build the same object at once, one copy remains", "[runtime][fetch]") {
  Pair pair(2);
  FetchCluster cluster(2, pair.objects, pair.setup);
  for (const size_t node : {0u, 1u}) {
    cluster[node].builder.at_once = false;
    cluster[node].cache.prefetch(std::array{1u});
  }
  cluster.run(milliseconds(20), milliseconds(1));
  for (const size_t node : {0u, 1u}) {
    REQUIRE(cluster[node].builder.pending());
    cluster[node].builder.answer();
  }
  cluster.run(milliseconds(20), milliseconds(1));
  CHECK(cluster[0].cache.find(1) == cluster[1].cache.find(1));
  CHECK(*cluster[0].builder.alive + *cluster[1].builder.alive == 1);
}

TEST_CASE("a node that shares nothing builds for itself", "[runtime][fetch]") {
  Pair pair(2);
  pair.setup.cache.shared = nullptr;
  FetchCluster cluster(2, pair.objects, pair.setup);
  for (const size_t node : {0u, 1u}) bring_shared(cluster, node, 1);
  CHECK(cluster[0].cache.find(1) != cluster[1].cache.find(1));
  CHECK(cluster[1].cache.counters().builds == 1);
  CHECK(cluster[1].cache.counters().builds_saved == 0);
}
