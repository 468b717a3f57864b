// A node for tests: a scheduler on a manual clock, with a scripted source. Tests call turn() and
// advance(); nothing waits. One thread.
#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <string>

#include "runtime/actor/scheduler.hpp"

namespace luxodus::test {

/// Records the scheduler's calls.
struct ScriptedSource final : EventSource {
  bool poll() override {
    if (on_poll) on_poll();
    return false;
  }
  void wait_until(Nanoseconds deadline) override { waited_until = deadline; }
  void wake() noexcept override { ++wakes; }

  std::function<void()> on_poll;
  Nanoseconds waited_until = 0;
  int wakes = 0;
};

inline SchedulerLimits small_limits(size_t fibers = 16) {
  SchedulerLimits limits;
  limits.fibers.count = fibers;
  limits.fibers.max_maps = 1000;
  return limits;
}

struct Node {
  explicit Node(const SchedulerLimits& limits = small_limits())
      : scheduler(limits, clock, source) {}

  FiberId start(const Task& body, const char* tag = "test") {
    const auto id = scheduler.fibers().start(tag, body);
    REQUIRE(id.has_value());
    return *id;
  }
  /// Turns until only time or the source could bring more work.
  void settle() {
    while (scheduler.turn() <= clock.now()) {
    }
  }
  void advance(Nanoseconds by) {
    clock.advance(by);
    settle();
  }
  void note(const std::string& what) { noted += what + " "; }

  ManualClock clock;
  ScriptedSource source;
  Scheduler scheduler;
  std::string noted;
};

}  // namespace luxodus::test
