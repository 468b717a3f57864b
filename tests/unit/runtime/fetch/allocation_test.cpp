#include "tests/kit/allocation_count.hpp"
#include "tests/unit/runtime/fetch/fetch_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("a fetch allocates only the object", "[runtime][fetch]") {
  constexpr uint32_t count = 8;
  Objects objects;
  for (uint32_t i = 0; i < count; ++i) objects.add(64, {{0}});
  FetchSetup setup;
  setup.cache = {.budget_bytes = 400, .largest_build_bytes = 100, .pinned_share = 0};
  FetchCluster cluster(1, objects, setup);
  FetchNode& node = cluster[0];
  node.builder.built.reserve(10'000);
  struct Walker {
    FetchNode& node;
    size_t rounds;
    size_t got = 0;
  };
  const auto walk = [&](size_t rounds) {
    Walker walker{node, rounds};
    node.start([&walker] {
      for (size_t i = 0; i < count * walker.rounds; ++i)
        if (walker.node.cache.get(i % count).how == Got::How::resident) ++walker.got;
    });
    while (node.fibers.live() > 0) {
      node.turn();
      cluster.clock.advance(microseconds(1));
    }
    return walker.got;
  };
  REQUIRE(walk(10) == 10 * count);
  const size_t before = allocations_of_this_thread();
  const size_t built = node.builder.built.size();
  const size_t got = walk(100);
  const size_t taken = allocations_of_this_thread() - before;
  CHECK(got == 100 * count);
  CHECK(node.builder.built.size() - built == 100 * count);
  if (allocations_are_counted()) CHECK(taken == 100 * count);  // one for each object built
}
