// After the seal a node's thread allocates no memory, whatever it does.
#include <catch2/catch.hpp>
#include <memory>

#include "runtime/actor/actor.hpp"
#include "runtime/observe/trace_ring.hpp"
#include "tests/kit/allocation_count.hpp"
#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;
using test::Node;

namespace {

struct Score {
  uint64_t particle;
  int weight;
};
struct SealedBeat {};

class Tally final : public Actor<Tally, ControlLane<Accepts<SealedBeat, 1, WhenFull::coalesce>>,
                                 DataLane<Accepts<Score, 8, WhenFull::wait>>> {
 public:
  explicit Tally(Scheduler& scheduler) : Actor(scheduler, "tally") {}
  void on(const SealedBeat&) { ++beats; }
  void on(const Score& score) {
    sum += score.weight;
    ++scores;
  }
  int sum = 0, scores = 0, beats = 0;
};

/// Work of one particle's fiber: all kinds of waits, and a message.
struct Stage {
  Stage() : node(test::small_limits(513)), tally(node.scheduler), trace(4096, 10) {}

  void follow(uint64_t particle) {
    Scheduler& scheduler = node.scheduler;
    scheduler.fibers().set_subject(particle);
    const Nanoseconds start = scheduler.clock().now();
    if (trace.wants(particle)) trace.record({start, particle, 0, 0, TracePhase::begin});
    if (scheduler.sleep_until(start + static_cast<Nanoseconds>(particle % 977)) != Wake::timed_out)
      return;
    if (scheduler.fibers().wait(objects, "object") != Wake::woken) return;
    const Wake answer = scheduler.wait_until(answers, start + milliseconds(2), "answer");
    if (answer == Wake::cancelled || scheduler.fibers().yield() == Wake::cancelled) return;
    if (tally.send(Score{particle, 3}) != Offered::taken ||
        tally.offer(SealedBeat{}) != Offered::taken)
      return;
    latency.add(scheduler.clock().now() - start);
  }
  void go_on() {
    node.scheduler.fibers().wake_all(objects);
    node.scheduler.fibers().wake_one(answers);
    node.clock.advance(microseconds(100));
    while (node.scheduler.turn() <= node.clock.now()) {
    }
  }

  Node node;
  Tally tally;
  TraceRing trace;
  Histogram latency;
  WaitList objects, answers;
};

}  // namespace

TEST_CASE("the allocations of this thread are counted", "[runtime][seal]") {
  if (!test::allocations_are_counted()) {
    WARN("sanitizers have an allocator of their own: nothing is counted in this build");
    return;
  }
  const uint64_t before = test::allocations_of_this_thread();
  const auto one = std::make_unique<int>(1);
  CHECK(test::allocations_of_this_thread() == before + *one);
}

TEST_CASE("after the seal thousands of fibers, messages, timers and waits allocate no memory",
          "[runtime][seal]") {
  Stage stage;
  Metrics metrics("n0");
  stage.node.scheduler.add_metrics(metrics);
  metrics.add_histogram({"latency", "", "Of particles.", ""}, stage.latency);
  stage.tally.start();
  stage.node.scheduler.seal();
  const uint64_t before = test::allocations_of_this_thread();

  constexpr uint64_t particles = 20'000;
  uint64_t started = 0;
  bool handed_over = false;
  for (int round = 0; stage.tally.scores < static_cast<int>(particles) && round < 20'000; ++round) {
    Stage* s = &stage;
    while (started < particles &&
           stage.node.scheduler.fibers().start("photon", [s, started] { s->follow(started); }))
      ++started;
    handed_over = stage.node.scheduler.handoff().give([s] { s->tally.scores += 0; });
    if (!handed_over) break;
    stage.go_on();
    metrics.publish();
  }

  const uint64_t taken = test::allocations_of_this_thread() - before;
  CHECK(taken == 0);
  CHECK(handed_over);
  CHECK(stage.tally.scores == static_cast<int>(particles));
  CHECK(stage.tally.sum == 3 * stage.tally.scores);
  CHECK(stage.tally.beats > 0);
  CHECK(stage.latency.count() == particles);
  CHECK(stage.trace.recorded() == particles / 10);
  stage.node.scheduler.fibers().cancel_all();
  stage.node.settle();
  CHECK(stage.node.scheduler.timers().set_now() == 0);
}
