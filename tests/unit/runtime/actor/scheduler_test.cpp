#include "runtime/actor/scheduler.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <thread>
#include <vector>

#include "runtime/core/random.hpp"
#include "tests/unit/runtime/actor/node_kit.hpp"
#include "tests/unit/runtime/core/forked_end.hpp"

using namespace luxodus;
using test::Node;

namespace {

struct NotingReceiver final : ControlReceiver {
  explicit NotingReceiver(Node& n) : node(n) {}
  void handle_control() override {
    node.note("control");
    if (again-- > 0) node.scheduler.call_for_control(*this);
  }
  Node& node;
  int again = 0;
};

}  // namespace

TEST_CASE("a turn serves timers, arrivals, control, results and fibers, in this order",
          "[runtime][scheduler]") {
  Node node;
  NotingReceiver receiver(node);
  node.start([&node] { node.note("fiber"); });
  REQUIRE(node.scheduler.handoff().give([&node] { node.note("result"); }));
  node.source.on_poll = [&node] { node.note("arrival"); };
  node.scheduler.timers().set(0, [&node] { node.note("timer"); });
  node.scheduler.call_for_control(receiver);
  node.scheduler.call_for_control(receiver);
  node.scheduler.turn();
  CHECK(node.noted == "timer arrival control result fiber ");
  CHECK(node.scheduler.counters().controls == 1);
}

TEST_CASE("a receiver that calls for control from its handler is called in the next turn",
          "[runtime][scheduler]") {
  Node node;
  NotingReceiver receiver(node);
  receiver.again = 1;
  node.scheduler.call_for_control(receiver);
  CHECK(node.scheduler.turn() <= node.clock.now());
  CHECK(node.noted == "control ");
  node.scheduler.turn();
  CHECK(node.noted == "control control ");
}

TEST_CASE("fibers that are always ready leave every turn after the limit of resumes",
          "[runtime][scheduler]") {
  SchedulerLimits limits = test::small_limits();
  limits.resumes_per_turn = 10;
  Node node(limits);
  for (int i = 0; i < 3; ++i)
    node.start([&node] {
      while (node.scheduler.fibers().yield() == Wake::woken) {
      }
    });
  CHECK(node.scheduler.turn() <= node.clock.now());
  CHECK(node.scheduler.counters().resumes == 10);
  node.scheduler.turn();
  CHECK(node.scheduler.counters().resumes == 20);
  node.scheduler.fibers().cancel_all();
  node.settle();
  CHECK(node.scheduler.fibers().live() == 0);
}

TEST_CASE("fibers leave a turn after their time limit", "[runtime][scheduler]") {
  Node node;
  for (int i = 0; i < 5; ++i) node.start([&node] { node.clock.advance(microseconds(400)); });
  node.scheduler.turn();
  CHECK(node.scheduler.counters().resumes == 3);  // 0.4, 0.8, 1.2 ms
  CHECK(node.scheduler.fibers().live() == 2);
}

TEST_CASE("a sleeping fiber wakes at its deadline and not before", "[runtime][scheduler]") {
  Node node;
  node.start([&node] {
    if (node.scheduler.sleep_until(milliseconds(5)) == Wake::timed_out) node.note("awake");
  });
  node.settle();
  CHECK(node.scheduler.turn() <= milliseconds(5));
  node.advance(milliseconds(5) - 1);
  CHECK(node.noted.empty());
  CHECK(node.scheduler.turn() == milliseconds(5));
  node.advance(1);
  CHECK(node.noted == "awake ");
  CHECK(node.scheduler.turn() == never);
}

TEST_CASE("a wait with a deadline ends by whichever comes first, and leaves no timer behind",
          "[runtime][scheduler]") {
  Node node;
  WaitList list;
  for (const Nanoseconds deadline : {milliseconds(1), milliseconds(9)})
    node.start([&node, &list, deadline] {
      const Wake how = node.scheduler.wait_until(list, deadline, "answer");
      node.note(how == Wake::timed_out ? "late" : how == Wake::woken ? "in time" : "cancelled");
    });
  node.settle();
  CHECK(node.scheduler.timers().set_now() == 2);
  node.advance(milliseconds(2));
  CHECK(node.noted == "late ");
  node.scheduler.fibers().wake_all(list);
  node.settle();
  CHECK(node.noted == "late in time ");
  CHECK(node.scheduler.timers().set_now() == 0);
  const FiberId id = node.start([&node, &list] {
    if (node.scheduler.wait_until(list, seconds(1), "answer") == Wake::cancelled)
      node.note("cancelled");
  });
  node.settle();
  node.scheduler.fibers().cancel(id);
  node.settle();
  CHECK(node.noted == "late in time cancelled ");
  CHECK(node.scheduler.timers().set_now() == 0);
}

TEST_CASE("a fiber that runs too long is reported with its tag and reason",
          "[runtime][scheduler]") {
  Node node;
  node.start([&node] { node.clock.advance(milliseconds(20)); }, "quick");
  node.settle();
  CHECK(node.scheduler.counters().stalls == 0);
  node.start(
      [&node] {
        node.scheduler.fibers().set_subject(4711);
        node.clock.advance(milliseconds(21));
        static_cast<void>(node.scheduler.fibers().suspend("fetch"));
      },
      "photon");
  node.settle();
  CHECK(node.scheduler.counters().stalls == 1);
  const Stall& stall = node.scheduler.last_stall();
  CHECK(std::string(stall.tag) == "photon");
  CHECK(std::string(stall.reason) == "fetch");
  CHECK(stall.subject == 4711);
  CHECK(stall.ran == milliseconds(21));
  node.scheduler.fibers().cancel_all();
  node.settle();
}

TEST_CASE("the handoff holds no more than its capacity, keeps the order, and wakes the node",
          "[runtime][scheduler]") {
  SchedulerLimits limits = test::small_limits();
  limits.handoffs = 2;
  Node node(limits);
  Handoff& handoff = node.scheduler.handoff();
  CHECK(handoff.give([&node] { node.note("first"); }));
  CHECK(handoff.give([&node] { node.note("second"); }));
  CHECK_FALSE(handoff.give([&node] { node.note("third"); }));
  CHECK(node.source.wakes == 2);
  node.settle();
  CHECK(node.noted == "first second ");
}

TEST_CASE("results of other threads wake a waiting node, and all arrive", "[runtime][scheduler]") {
  const SystemClock clock;
  QuietSource source(clock);
  Scheduler scheduler(test::small_limits(), clock, source);
  static constexpr int builders = 4, results_each = 500;
  int arrived = 0;
  Shutdown& shutdown = scheduler.shutdown();
  std::vector<std::thread> threads;
  for (int b = 0; b < builders; ++b)
    threads.emplace_back([&] {
      for (int i = 0; i < results_each;) {
        const bool taken = scheduler.handoff().give([&arrived, &shutdown] {
          if (++arrived == builders * results_each) shutdown.begin("all results are here");
        });
        if (taken)
          ++i;
        else
          std::this_thread::yield();
      }
    });
  scheduler.run();
  for (std::thread& thread : threads) thread.join();
  CHECK(arrived == builders * results_each);
}

TEST_CASE("the same node behaves the same way every time it is run", "[runtime][scheduler]") {
  const auto history = [] {
    Node node;
    Random random(11, RandomStream::test);
    random.start(3);
    WaitList list;
    std::vector<int> order;
    struct Setting {
      Node& node;
      Random& random;
      WaitList& list;
      std::vector<int>& order;
    } setting{node, random, list, order};
    for (int i = 0; i < 12; ++i)
      node.start([s = &setting, i] {
        Scheduler& scheduler = s->node.scheduler;
        for (int step = 0; step < 40; ++step) {
          s->order.push_back(i);
          const uint32_t choice = s->random.bits() % 4;
          const Nanoseconds later = s->node.clock.now() + s->random.bits() % 100'000;
          Wake how = Wake::woken;
          if (choice == 0) how = scheduler.fibers().yield();
          if (choice == 1) how = scheduler.sleep_until(later);
          if (choice == 2) how = scheduler.wait_until(s->list, later, "list");
          if (choice == 3) scheduler.fibers().wake_one(s->list);
          if (how == Wake::cancelled) return;
        }
      });
    while (node.scheduler.fibers().live() > 0) node.advance(microseconds(7));
    return order;
  };
  const auto first = history();
  CHECK(first.size() == 12 * 40);
  CHECK(history() == first);
}

TEST_CASE("a memory plan of a scheduler names its stacks, fibers, timers and results",
          "[runtime][scheduler]") {
  SchedulerLimits limits;
  limits.fibers.count = 1000;
  limits.fibers.stack_bytes = 32 * 1024;
  MemoryPlan plan;
  Scheduler::plan_memory(plan, limits);
  REQUIRE(plan.terms().size() == 4);
  CHECK(plan.terms()[0].bytes == 1000 * 32 * 1024);
  CHECK(plan.total_bytes() > plan.terms()[0].bytes);
}

TEST_CASE("the scheduler's own numbers can be published", "[runtime][scheduler]") {
  Node node;
  Metrics metrics("n0");
  node.scheduler.add_metrics(metrics);
  node.start([] {});
  node.settle();
  CHECK(metrics.publish());
  const std::string text = Metrics::published({&metrics});
  CHECK(text.find("luxodus_fiber_resumes_total{node=\"n0\"} 1\n") != std::string::npos);
}

TEST_CASE("a stack overflow under the running scheduler is reported in one line",
          "[runtime][scheduler]") {
  const test::End end = test::end_of([] {
    const SystemClock clock;
    QuietSource source(clock);
    Scheduler scheduler(test::small_limits(2), clock, source);
    const auto id = scheduler.fibers().start("photon", [] {
      struct Deep {
        static int down(int levels) {
          volatile char room[512];
          for (volatile char& byte : room) byte = static_cast<char>(levels);
          return levels == 0 ? room[0] : down(levels - 1) + room[0];
        }
      };
      Deep::down(10'000);
    });
    if (id) scheduler.run();
  });
  CHECK(end.signal == SIGSEGV);
  CHECK(end.standard_error.find("fiber 0 (photon) overflowed its stack") != std::string::npos);
}

TEST_CASE("the longest turn counts CPU time, which short turns seldom read",
          "[runtime][scheduler]") {
  struct SharedMachine final : Clock {
    Nanoseconds now() const override { return elapsed; }
    Nanoseconds processor() const override {
      ++readings;
      return taken;
    }
    void run(Nanoseconds span) { elapsed += span, taken += span; }
    void run_others(Nanoseconds span) { elapsed += span; }
    Nanoseconds elapsed = seconds(1), taken = 0;
    mutable int readings = 0;
  } machine;
  test::ScriptedSource source;
  Scheduler scheduler(test::small_limits(), machine, source);
  const auto longest = [&] { return static_cast<Nanoseconds>(scheduler.counters().longest_turn); };
  source.on_poll = [&] { machine.run(milliseconds(3)); };
  scheduler.turn();
  CHECK(longest() == milliseconds(3));
  source.on_poll = [&] {
    machine.run(milliseconds(1));
    machine.run_others(milliseconds(50));
  };
  scheduler.turn();
  CHECK(longest() == milliseconds(3));
  // A thousand turns of 1 us: the CPU time is read once in `processor_resolution`.
  machine.readings = 0;
  source.on_poll = [&] { machine.run(microseconds(1)); };
  for (int i = 0; i < 1000; ++i) scheduler.turn();
  CHECK(machine.readings <= milliseconds(1) / Scheduler::processor_resolution + 1);
  CHECK(longest() == milliseconds(3));
  // After these, a turn that others interrupt is measured to that resolution.
  source.on_poll = [&] {
    machine.run(milliseconds(4));
    machine.run_others(milliseconds(50));
  };
  scheduler.turn();
  CHECK(longest() >= milliseconds(4));
  CHECK(longest() <= milliseconds(4) + Scheduler::processor_resolution);
}
