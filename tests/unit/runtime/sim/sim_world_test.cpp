#include "runtime/sim/sim_world.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <optional>
#include <set>

#include "runtime/actor/timers.hpp"
#include "runtime/sim/swarm.hpp"

using namespace luxodus;

namespace {

constexpr NodeId first{0}, second{1};

/// Sends a number every millisecond, up to a count, and records what arrives.
class CountingNode final : public SimNode {
 public:
  CountingNode(SimWorld& world, NodeId self, int sends)
      : clock_(world.clock(self)), transport_(world.transport(self)), sends_(sends) {
    next_at_ = clock_.now();
  }
  Nanoseconds turn() override {
    while (const auto arrival = transport_.receive()) {
      uint32_t number = 0;
      REQUIRE(arrival->bytes.size() >= sizeof number);
      std::memcpy(&number, arrival->bytes.data(), sizeof number);
      came.push_back(number);
      came_at.push_back(clock_.now());
    }
    if (sent_ < sends_ && clock_.now() >= next_at_) {
      const auto number = static_cast<uint32_t>(sent_++);
      const NodeId other{static_cast<uint16_t>(1 - self().value)};
      outcomes[transport_.send(other, Lane::control, std::as_bytes(std::span(&number, 1)), {})]++;
      next_at_ += milliseconds(1);
    }
    return sent_ < sends_ ? next_at_ : never;
  }
  bool finished() const override { return false; }
  void die() override { died = true; }
  NodeId self() const { return self_; }
  void be(NodeId self) { self_ = self; }

  std::vector<uint32_t> came;
  std::vector<Nanoseconds> came_at;
  std::map<Sent, int> outcomes;
  bool died = false;

 private:
  SimClock& clock_;
  Transport& transport_;
  const int sends_;
  int sent_ = 0;
  Nanoseconds next_at_ = 0;
  NodeId self_;
};

struct Pair {
  explicit Pair(const FaultPlan& plan, int sends = 1000, uint64_t seed = 1) {
    SimSetup setup;
    setup.nodes = 2;
    setup.edges = {{first, second}};
    setup.plan = plan;
    setup.plan.seed = seed;
    world.emplace(setup);
    world->start([this, sends](NodeId node, uint32_t life) {
      auto made = std::make_unique<CountingNode>(*world, node, node == first ? sends : 0);
      made->be(node);
      lives[node.value] = life + 1;
      nodes[node.value] = made.get();
      return made;
    });
  }
  void run(Nanoseconds until) {
    while (world->now() < until && world->step()) {
    }
  }
  std::optional<SimWorld> world;
  std::array<CountingNode*, 2> nodes{};
  std::array<uint32_t, 2> lives{};
};

FaultPlan quiet() {
  FaultPlan plan;
  plan.links.delay = microseconds(50);
  plan.links.tail = milliseconds(50);
  plan.healed_at = seconds(100);
  return plan;
}

}  // namespace

TEST_CASE("frames arrive after the link's delay, in order", "[sim]") {
  FaultPlan plan = quiet();
  plan.links.delay = milliseconds(7);
  plan.links.jitter = milliseconds(3);
  Pair pair(plan);
  pair.run(seconds(2));
  REQUIRE(pair.nodes[1]->came.size() == 1000);
  for (uint32_t i = 0; i < 1000; ++i) {
    CHECK(pair.nodes[1]->came[i] == i);
    CHECK(pair.nodes[1]->came_at[i] >= milliseconds(7 + i));
    CHECK(pair.nodes[1]->came_at[i] <= milliseconds(7 + i) + milliseconds(4));
  }
}

TEST_CASE("the same seed gives the same run, and another seed another", "[sim]") {
  FaultPlan plan = quiet();
  plan.links.loss = plan.links.duplication = plan.links.reordering = plan.links.corruption = 0.1;
  const auto hash_of = [&](uint64_t seed) {
    Pair pair(plan, 300, seed);
    pair.run(seconds(2));
    return pair.world->trace_hash();
  };
  CHECK(hash_of(3) == hash_of(3));
  CHECK(hash_of(3) != hash_of(4));
}

TEST_CASE("links lose, duplicate and reorder at their configured rates", "[sim]") {
  FaultPlan plan = quiet();
  SECTION("loss") {
    plan.links.loss = 0.2;
    Pair pair(plan, 10'000);
    pair.run(seconds(20));
    CHECK(pair.nodes[1]->came.size() > 7'700);
    CHECK(pair.nodes[1]->came.size() < 8'300);
    CHECK(pair.nodes[0]->outcomes[Sent::taken] == 10'000);  // taken is not delivered
  }
  SECTION("duplication") {
    plan.links.duplication = 0.2;
    Pair pair(plan, 10'000);
    pair.run(seconds(20));
    CHECK(pair.nodes[1]->came.size() > 11'700);
    CHECK(pair.nodes[1]->came.size() < 12'300);
    const std::set<uint32_t> all(pair.nodes[1]->came.begin(), pair.nodes[1]->came.end());
    CHECK(all.size() == 10'000);
  }
  SECTION("reordering") {
    plan.links.reordering = 0.2;
    Pair pair(plan, 1'000);
    pair.run(seconds(20));
    CHECK(pair.nodes[1]->came.size() == 1'000);
    CHECK_FALSE(std::is_sorted(pair.nodes[1]->came.begin(), pair.nodes[1]->came.end()));
  }
  SECTION("corruption") {
    plan.links.corruption = 0.5;
    Pair pair(plan, 1'000);
    pair.run(seconds(20));
    int wrong = 0;
    for (uint32_t i = 0; i < 1'000; ++i) wrong += pair.nodes[1]->came[i] != i ? 1 : 0;
    CHECK(wrong > 300);
    CHECK(wrong < 700);
  }
}

TEST_CASE("after healing no faults occur", "[sim]") {
  FaultPlan plan = quiet();
  plan.links.loss = plan.links.duplication = plan.links.corruption = 0.5;
  plan.healed_at = 0;
  Pair pair(plan);
  pair.run(seconds(2));
  CHECK(pair.nodes[1]->came.size() == 1000);
  CHECK(pair.world->counters().lost == 0);
}

TEST_CASE("a cut loses frames silently, a broken connection notifies both ends", "[sim]") {
  FaultPlan plan = quiet();
  Fault fault;
  fault.at = milliseconds(100);
  fault.lasts = milliseconds(200);
  fault.node = first;
  fault.peer = second;
  SECTION("cut") {
    fault.kind = Fault::Kind::cut;
    plan.faults = {fault};
    Pair pair(plan);
    pair.run(seconds(2));
    CHECK(pair.nodes[0]->outcomes[Sent::taken] == 1000);
    CHECK(pair.nodes[1]->came.size() > 795);
    CHECK(pair.nodes[1]->came.size() < 805);
  }
  SECTION("disconnect") {
    fault.kind = Fault::Kind::disconnect;
    plan.faults = {fault};
    Pair pair(plan);
    pair.run(seconds(2));
    CHECK(pair.nodes[0]->outcomes[Sent::unreachable] > 95);  // until it reconnects
    CHECK(pair.nodes[0]->outcomes[Sent::unreachable] < 105);
  }
  SECTION("clog") {
    fault.kind = Fault::Kind::clog;
    plan.faults = {fault};
    Pair pair(plan);
    pair.run(seconds(2));
    CHECK(pair.nodes[1]->came.size() == 1000);
    CHECK(pair.nodes[1]->came_at[150] >= milliseconds(300));
  }
}

TEST_CASE("a crashed node loses the frames in flight to it, and restarts", "[sim]") {
  FaultPlan plan = quiet();
  plan.links.delay = milliseconds(50);
  plan.faults = {{Fault::Kind::crash, milliseconds(500), milliseconds(200), second, {}, 1}};
  Pair pair(plan);
  pair.run(milliseconds(499));
  const size_t before = pair.nodes[1]->came.size();
  CHECK(before > 430);
  pair.run(milliseconds(600));
  CHECK(pair.world->node(second) == nullptr);
  pair.run(seconds(2));
  CHECK(pair.lives[1] == 2);
  CHECK(pair.nodes[1]->came.front() > 690);  // nothing that was sent to the life before
  CHECK(pair.nodes[0]->outcomes[Sent::unreachable] > 150);
}

TEST_CASE("a paused node stops, a slow one takes longer", "[sim]") {
  FaultPlan plan = quiet();
  plan.faults = {{Fault::Kind::pause, milliseconds(100), milliseconds(300), first, {}, 1}};
  Pair pair(plan);
  pair.run(milliseconds(390));
  CHECK(pair.nodes[1]->came.size() < 105);
  pair.run(seconds(2));
  CHECK(pair.nodes[1]->came.size() == 1000);

  SimClock clock;
  clock.set_slowness(3);
  clock.charge(100);
  CHECK(clock.now() == 300);
  clock.reach(200);
  CHECK(clock.now() == 300);
}

TEST_CASE("swarms differ from seed to seed, and no fault outlasts their healing", "[sim]") {
  SwarmFrame frame;
  frame.nodes = 5;
  for (uint16_t i = 0; i < 5; ++i)
    for (uint16_t j = static_cast<uint16_t>(i + 1); j < 5; ++j) frame.edges.push_back({{i}, {j}});
  frame.spared = {{4}};
  std::set<size_t> sizes;
  std::array<int, drawn_fault_kinds> seen{};
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const FaultPlan plan = swarm(seed, frame);
    sizes.insert(plan.faults.size());
    CHECK(plan.healed_at == frame.lasts);
    for (const Fault& fault : plan.faults) {
      ++seen[static_cast<size_t>(fault.kind)];
      CHECK(fault.at + fault.lasts <= frame.lasts + 1);
      CHECK(fault.lasts > 0);
      CHECK(fault.node.value < 5);
      if (fault.kind == Fault::Kind::crash) CHECK(fault.node.value != 4);
    }
  }
  CHECK(sizes.size() > 10);
  for (const int count : seen) CHECK(count > 20);
}
