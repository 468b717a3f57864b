// A node that traces states of a scene leaves one while a batch of it is being merged, in steps.
// The test plays the tracer and controls each step of a merge.
#include "actors/cast/tracing/state_tracer.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <utility>
#include <vector>

#include "tests/kit/lone_actor.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"
#include "tests/unit/actors/cast/tracing/noted_port.hpp"

using namespace luxodus;

namespace {

/// Which totals were written, and what happens in the middle of the next merge.
struct Merges {
  std::vector<const Totals*> into;
  std::function<void()> meanwhile;
};

/// A batch is one portion; merging it takes two steps.
struct SteppedWorker final : BatchWorker {
  explicit SteppedWorker(Merges& of) : merges(of) {}
  void begin(const BatchRange&) override {}
  bool go_on() override { return false; }
  void merge_into(Totals& totals, const std::function<void()>& rest) override {
    rest();
    if (merges.meanwhile) std::exchange(merges.meanwhile, {})();
    rest();
    merges.into.push_back(&totals);
  }
  Merges& merges;
};

struct SteppedState final : TracedState {
  SteppedState(const CompiledScene& in, Merges& of) : scene(in), merges(of) {}
  std::unique_ptr<Totals> totals() const override { return empty_totals(scene); }
  std::unique_ptr<BatchWorker> worker(uint64_t, int64_t, const TracerMaker&) const override {
    return std::make_unique<SteppedWorker>(merges);
  }
  const CompiledScene& scene;
  Merges& merges;
};

struct SteppedStates final : StateMaker {
  explicit SteppedStates(const CompiledScene& in) : scene(in) {}
  Result<std::shared_ptr<const TracedState>> make(const std::string&) override {
    std::shared_ptr<const TracedState> state = std::make_shared<SteppedState>(scene, merges);
    return state;
  }
  const CompiledScene& scene;
  Merges merges;
};

struct TracingNode : test::LoneNode {
  TracingNode() {
    for (const StateObject& state : {first, second}) {
      const std::string bytes = state.bytes();
      REQUIRE(work.learn(state.id(), std::as_bytes(std::span(bytes))).ok());
      if (state == first) work.enter(first.id());
    }
    work.start();
  }
  ~TracingNode() { end_fibers(); }
  /// Traces a batch of the first state; `meanwhile` runs during its merge.
  void trace(std::function<void()> meanwhile) {
    states.merges.meanwhile = std::move(meanwhile);
    work.add(7, 0);
    work.look_again();
    settle();
    REQUIRE_FALSE(states.merges.meanwhile);
  }

  const StateObject first{1, "first"}, second{1, "second"};
  const std::shared_ptr<const CompiledScene> scene = scene_of("empty_room", "", 1);
  SteppedStates states{*scene};
  test::NotedPort port;
  StateTracer work{*scene, states, 1, scheduler, port};
};

}  // namespace

TEST_CASE("a batch being merged is in the totals when its lease is done", "[states]") {
  TracingNode node;
  node.trace([&] {
    CHECK_FALSE(node.work.may_give());  // these totals are being written
    CHECK_FALSE(node.work.forget_merged());
    node.work.drop_all();  // the merge goes on: otherwise half a batch would be left in the totals
  });
  CHECK(node.port.done == std::vector<uint64_t>{7});
  REQUIRE(node.work.may_give());
  REQUIRE(node.states.merges.into.size() == 1);
  CHECK(&node.work.give_totals() == node.states.merges.into.front());
}

TEST_CASE("a state left during the merge of its batch gets no report of it", "[states]") {
  TracingNode node;
  const auto leave = [&] {
    node.work.leave_state();
    CHECK(node.work.at_hand() == 0);
    CHECK_FALSE(node.work.may_give());
  };
  SECTION("another is not entered") {
    node.trace(leave);
    CHECK(node.port.done.empty());
    CHECK(node.work.counters().batches == 0);
    CHECK(node.work.may_give());
  }
  SECTION("another is entered") {
    node.trace([&] {
      leave();
      node.work.enter(node.second.id());
      node.work.add(8, 0);
    });
    CHECK(node.port.done == std::vector<uint64_t>{8});
    CHECK(node.work.counters().batches == 1);
    REQUIRE(node.states.merges.into.size() == 2);
    CHECK(node.states.merges.into[0] != node.states.merges.into[1]);
    CHECK(&node.work.give_totals() == node.states.merges.into[1]);
  }
}
