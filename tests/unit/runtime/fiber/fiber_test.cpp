#include "runtime/fiber/fiber.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/runtime/core/forked_end.hpp"

using namespace luxodus;

namespace {

/// The fibers of one test, and their output.
struct Stage {
  explicit Stage(size_t count = 8) : fibers({count, default_stack_bytes(), 1000}) {}

  FiberId start(const Task& body) {
    const auto id = fibers.start("test", body);
    REQUIRE(id.has_value());
    return *id;
  }
  void run() {
    while (fibers.any_ready()) fibers.run_next();
  }
  void note(const std::string& what) { noted += what + " "; }

  Fibers fibers;
  WaitList list;
  std::string noted;
};

}  // namespace

TEST_CASE("fibers run in the order in which they became ready", "[runtime][fiber]") {
  Stage stage;
  for (int i = 0; i < 3; ++i)
    stage.start([&stage, i] {
      stage.note("a" + std::to_string(i));
      if (stage.fibers.yield() == Wake::woken) stage.note("b" + std::to_string(i));
    });
  stage.run();
  CHECK(stage.noted == "a0 a1 a2 b0 b1 b2 ");
}

TEST_CASE("a wait list wakes in order of arrival, one fiber or all", "[runtime][fiber]") {
  Stage stage;
  for (int i = 0; i < 3; ++i)
    stage.start([&stage, i] {
      if (stage.fibers.wait(stage.list, "door") == Wake::woken) stage.note(std::to_string(i));
    });
  stage.run();
  CHECK(stage.fibers.suspended() == 3);
  CHECK(stage.fibers.wake_one(stage.list));
  stage.run();
  CHECK(stage.noted == "0 ");
  stage.fibers.wake_all(stage.list);
  stage.run();
  CHECK(stage.noted == "0 1 2 ");
  CHECK_FALSE(stage.fibers.wake_one(stage.list));
  CHECK(stage.fibers.live() == 0);
}

TEST_CASE("a suspended fiber is woken by its id, and an old id wakes none", "[runtime][fiber]") {
  Stage stage(1);
  const auto body = [&stage] {
    if (stage.fibers.suspend("bell") == Wake::woken) stage.note("woken");
  };
  const FiberId first = stage.start(body);
  stage.run();
  CHECK(stage.fibers.wake(first));
  CHECK_FALSE(stage.fibers.wake(first));
  stage.run();
  CHECK(stage.noted == "woken ");
  CHECK_FALSE(stage.fibers.wake(first));
  const FiberId second = stage.start(body);
  stage.run();
  CHECK(second != first);
  CHECK_FALSE(stage.fibers.wake(first));
  CHECK_FALSE(stage.fibers.cancel(first));
  CHECK(stage.fibers.cancel(second));
  stage.run();
  CHECK(stage.fibers.live() == 0);
}

TEST_CASE("a fiber in a wait list is not woken by its id, but may time out", "[runtime][fiber]") {
  Stage stage;
  const FiberId id = stage.start([&stage] {
    if (stage.fibers.wait(stage.list, "place") == Wake::timed_out) stage.note("too late");
  });
  stage.run();
  CHECK_FALSE(stage.fibers.wake(id));
  CHECK(stage.fibers.time_out(id));
  CHECK(stage.list.empty());
  CHECK_FALSE(stage.fibers.time_out(id));
  stage.run();
  CHECK(stage.noted == "too late ");
}

TEST_CASE("a cancelled fiber is told so at its suspend, and at every later one",
          "[runtime][fiber]") {
  Stage stage;
  const FiberId id = stage.start([&stage] {
    while (stage.fibers.wait(stage.list, "work") == Wake::woken) stage.note("worked");
    stage.note(stage.fibers.cancelled() ? "asked to end" : "?");
    if (stage.fibers.yield() == Wake::cancelled) stage.note("asked again");
  });
  stage.run();
  stage.fibers.wake_one(stage.list);
  stage.run();
  CHECK(stage.fibers.cancel(id));
  CHECK(stage.list.empty());
  stage.run();
  CHECK(stage.noted == "worked asked to end asked again ");
  CHECK(stage.fibers.live() == 0);
}

TEST_CASE("a cancellation after a wake does not lose what the wake handed over",
          "[runtime][fiber]") {
  Stage stage;
  const FiberId id = stage.start([&stage] {
    stage.note(stage.fibers.wait(stage.list, "x") == Wake::woken ? "got it" : "lost it");
    stage.note(stage.fibers.wait(stage.list, "y") == Wake::cancelled ? "ended" : "?");
  });
  stage.run();
  stage.fibers.wake_one(stage.list);
  stage.fibers.cancel(id);
  stage.run();
  CHECK(stage.noted == "got it ended ");
}

TEST_CASE("destructors of cancelled fibers run, and the pool is full again", "[runtime][fiber]") {
  Stage stage(4);
  auto held = std::make_shared<int>(7);
  const std::shared_ptr<int>* source = &held;
  for (int i = 0; i < 4; ++i)
    stage.start([&stage, source] {
      const std::shared_ptr<int> mine = *source;
      while (stage.fibers.wait(stage.list, "for ever") == Wake::woken) {
      }
    });
  stage.run();
  CHECK(held.use_count() == 5);
  CHECK_FALSE(stage.fibers.start("one too many", [] {}).has_value());
  stage.fibers.cancel_all();
  stage.run();
  CHECK(held.use_count() == 1);
  CHECK(stage.fibers.live() == 0);
  CHECK(stage.fibers.max_live() == 4);
}

TEST_CASE("a later body runs on the stack of the one before it", "[runtime][fiber]") {
  Stage stage(1);
  int sum = 0;
  for (int i = 1; i <= 1000; ++i) {
    stage.start([&sum, i] { sum += i; });
    stage.run();
  }
  CHECK(sum == 500500);
}

TEST_CASE("exceptions stay in the fiber that throws them, however fibers alternate",
          "[runtime][fiber]") {
  Stage stage(8);
  for (int i = 0; i < 8; ++i)
    stage.start([&stage, i] {
      for (int turn = 0; turn < 20; ++turn) {
        try {
          if (stage.fibers.yield() == Wake::cancelled) return;
          throw std::runtime_error(std::to_string(i));
        } catch (const std::exception& e) {
          if (e.what() != std::to_string(i)) stage.note("swapped");
        }
        if (stage.fibers.yield() == Wake::cancelled) return;
      }
      stage.note("whole");
    });
  stage.run();
  CHECK(stage.noted == "whole whole whole whole whole whole whole whole ");
}

TEST_CASE("a fiber that breaks a rule aborts the process with that rule", "[runtime][fiber]") {
  const auto has = [](const test::End& end, const char* words) {
    return end.signal == SIGABRT && end.standard_error.find(words) != std::string::npos;
  };
  CHECK(has(test::end_of([] {
              Stage stage;
              stage.start([&stage] {
                try {
                  throw 1;
                } catch (...) {
                  static_cast<void>(stage.fibers.suspend("in a handler"));
                }
              });
              stage.run();
            }),
            "while an exception is thrown or handled"));
  CHECK(has(test::end_of([] {
              Stage stage;
              stage.start([&stage] {
                const NoSuspend resident(stage.fibers);
                static_cast<void>(stage.fibers.suspend("between resident and used"));
              });
              stage.run();
            }),
            "NoSuspend forbids"));
  CHECK(has(test::end_of([] {
              Stage stage;
              static_cast<void>(stage.fibers.suspend("on the scheduler's stack"));
            }),
            "outside of any fiber"));
  CHECK(has(test::end_of([] {
              Stage stage;
              stage.start([] { throw std::runtime_error("not mine"); });
              stage.run();
            }),
            "an exception left fiber test: not mine"));
}
