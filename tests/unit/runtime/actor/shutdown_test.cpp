#include "runtime/actor/shutdown.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "runtime/actor/actor.hpp"
#include "tests/unit/runtime/actor/node_kit.hpp"

using namespace luxodus;
using test::Node;

namespace {

/// A phase that is done when `flag` is true, and notes its beginning.
ShutdownPhase phase(Node& node, const std::string& name, Nanoseconds most, const bool& flag) {
  return {name, most, [&node, name] { node.note(name); }, [&flag] { return flag; },
          [name] { return "the " + name + " flag"; }};
}

/// The outcome of each phase, as text.
std::vector<std::string> outcomes(const Shutdown& shutdown) {
  std::vector<std::string> out;
  for (const Shutdown::Outcome& o : shutdown.outcomes())
    out.push_back(o.phase + (o.done ? ": done" : ": gave up on " + o.waited_for));
  return out;
}

}  // namespace

TEST_CASE("phases follow each other, each begun when the one before is done",
          "[runtime][shutdown]") {
  Node node;
  bool admitted = false, flushed = false;
  Shutdown& shutdown = node.scheduler.shutdown();
  shutdown.add(phase(node, "stop", seconds(1), admitted));
  shutdown.add(phase(node, "flush", seconds(1), flushed));
  node.settle();
  CHECK(node.noted.empty());
  shutdown.begin("a test");
  shutdown.begin("again");
  node.settle();
  CHECK(node.noted == "stop ");
  flushed = true;
  node.advance(milliseconds(1));
  CHECK(node.noted == "stop ");
  admitted = true;
  node.settle();
  CHECK(node.noted == "stop flush ");
  CHECK(shutdown.finished());
  CHECK(outcomes(shutdown) == std::vector<std::string>{"stop: done", "flush: done"});
}

TEST_CASE(
    "a phase that misses its deadline is abandoned with what it waited for, and the shutdown goes "
    "on",
    "[runtime][shutdown]") {
  Node node;
  const bool no = false, yes = true;
  Shutdown& shutdown = node.scheduler.shutdown();
  shutdown.add(phase(node, "flush", milliseconds(1500), no));
  shutdown.add(phase(node, "bye", seconds(1), yes));
  shutdown.begin("a test");
  CHECK(node.scheduler.turn() == seconds(1));  // then it logs what it waits for
  node.advance(seconds(1));
  CHECK_FALSE(shutdown.finished());
  CHECK(node.scheduler.turn() == milliseconds(1500));
  node.advance(milliseconds(499));
  CHECK_FALSE(shutdown.finished());
  node.advance(milliseconds(1));
  CHECK(shutdown.finished());
  CHECK(outcomes(shutdown) ==
        std::vector<std::string>{"flush: gave up on the flush flag", "bye: done"});
}

TEST_CASE("all pools are full again after a shutdown in the middle of work",
          "[runtime][shutdown]") {
  struct Work {
    int number;
  };
  class Slow final : public Actor<Slow, ControlLane<>, DataLane<Accepts<Work, 2, WhenFull::wait>>> {
   public:
    explicit Slow(Scheduler& scheduler) : Actor(scheduler, "slow") {}
    void on(const Work&) {
      static_cast<void>(scheduler().sleep_until(scheduler().clock().now() + milliseconds(3)));
    }
  };
  Node node(test::small_limits(64));
  Slow slow(node.scheduler);
  slow.start();
  WaitList nothing;
  const auto held = std::make_shared<int>(1);
  const std::shared_ptr<int>* source = &held;
  for (int i = 0; i < 60; ++i)
    node.start([&, source, i] {
      const std::shared_ptr<int> mine = *source;
      Scheduler& scheduler = node.scheduler;
      for (Wake how = Wake::woken; how != Wake::cancelled;) {
        if (i % 4 == 0) how = scheduler.sleep_until(scheduler.clock().now() + microseconds(50 * i));
        if (i % 4 == 1) how = scheduler.wait_until(nothing, scheduler.clock().now() + 999, "x");
        if (i % 4 == 2) how = scheduler.fibers().wait(nothing, "y");
        if (i % 4 == 3 && slow.send(Work{i}) == Offered::cancelled) how = Wake::cancelled;
      }
    });
  for (int i = 0; i < 20; ++i) {
    node.clock.advance(microseconds(333));
    node.scheduler.turn();
  }
  Shutdown& shutdown = node.scheduler.shutdown();
  shutdown.add(node.scheduler.end_all_fibers(seconds(1)));
  CHECK(node.scheduler.fibers().live() == 61);
  shutdown.begin("a test");
  node.settle();
  CHECK(outcomes(shutdown) == std::vector<std::string>{"end all fibers: done"});
  CHECK(node.scheduler.fibers().live() == 0);
  CHECK(node.scheduler.fibers().suspended() == 0);
  CHECK(node.scheduler.timers().set_now() == 0);
  CHECK(held.use_count() == 1);
}

TEST_CASE("fibers that have not ended in time are named with their tag and reason",
          "[runtime][shutdown]") {
  Node node;
  for (int i = 0; i < 2; ++i)
    node.start(
        [&node] {
          while (node.scheduler.fibers().suspend("fetch") == Wake::woken) {
          }
        },
        "photon");
  node.settle();
  Shutdown& shutdown = node.scheduler.shutdown();
  shutdown.add(node.scheduler.end_all_fibers(0));
  shutdown.begin("a test");
  node.scheduler.turn();
  CHECK(outcomes(shutdown) ==
        std::vector<std::string>{
            "end all fibers: gave up on 2 fibers: photon in fetch, photon in fetch"});
  node.settle();
  CHECK(node.scheduler.fibers().live() == 0);
}
