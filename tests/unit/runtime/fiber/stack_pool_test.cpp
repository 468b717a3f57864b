#include "runtime/fiber/stack_pool.hpp"

#include <catch2/catch.hpp>
#include <csignal>

#include "runtime/fiber/fiber.hpp"
#include "runtime/fiber/overflow_report.hpp"
#include "tests/unit/runtime/core/forked_end.hpp"

using namespace luxodus;

namespace {

/// Uses about 512 bytes of stack a level, below what a compiler may leave out.
int deep(int levels) {
  volatile char room[512];
  for (volatile char& byte : room) byte = static_cast<char>(levels);
  return levels == 0 ? room[0] : deep(levels - 1) + room[0];
}

}  // namespace

TEST_CASE("stacks are disjoint, of the requested size but for their colour, and aligned",
          "[runtime][stack]") {
  const StackPool stacks(40, 32 * 1024, 1000);
  CHECK(stacks.guard_every() == 1);
  for (size_t i = 0; i < stacks.count(); ++i) {
    const StackSpan span = stacks.stack(i);
    CHECK(span.bytes <= 32 * 1024);
    CHECK(span.bytes >= 30 * 1024);
    CHECK(reinterpret_cast<uintptr_t>(span.low + span.bytes) % 16 == 0);
    if (i > 0) {
      const StackSpan below = stacks.stack(i - 1);
      CHECK(below.low + below.bytes + 16 * 1024 <= span.low);
    }
    CHECK(stacks.place_of(span.low).index == i);
    CHECK_FALSE(stacks.place_of(span.low).in_guard);
    CHECK(stacks.place_of(span.low - 1).in_guard);
    CHECK(stacks.place_of(span.low - 16 * 1024).in_guard);
  }
}

TEST_CASE("beyond the limit of maps every k-th stack has a guard and the others a canary",
          "[runtime][stack]") {
  const StackPool stacks(100, 16 * 1024, 50);
  CHECK(stacks.guard_every() == 4);
  CHECK(stacks.guarded(0));
  CHECK_FALSE(stacks.guarded(3));
  CHECK(stacks.canary_lives(3));
  *stacks.stack(3).low = 'x';
  CHECK_FALSE(stacks.canary_lives(3));
  CHECK(stacks.canary_lives(2));
}

TEST_CASE("the overflow of a guarded stack is reported in one line", "[runtime][stack]") {
  const test::End end = test::end_of([] {
    const OverflowReport report;
    Fibers fibers({2, 16 * 1024, 100});
    if (!fibers.start("first", [] {})) return;
    if (!fibers.start("photon", [] { deep(1000); })) return;
    while (fibers.any_ready()) fibers.run_next();
  });
  CHECK(end.by_signal);
  CHECK(end.signal == SIGSEGV);
  CHECK(end.standard_error ==
        "luxodus: fiber 1 (photon) overflowed its stack of 16384 bytes; raise stack_kb\n");
}

TEST_CASE("the overflow of a stack without a guard is found at its fiber's next suspend",
          "[runtime][stack]") {
  const test::End end = test::end_of([] {
    Fibers fibers({2, 16 * 1024, 2});
    if (!fibers.start("first", [] {})) return;
    if (!fibers.start("photon", [] { deep(40); })) return;
    while (fibers.any_ready()) fibers.run_next();
  });
  CHECK(end.signal == SIGABRT);
  CHECK(end.standard_error.find("overflowed its stack") != std::string::npos);
}

TEST_CASE("a fault that is no overflow goes to the previous handler", "[runtime][stack]") {
  const test::End end = test::end_of([] {
    std::signal(SIGSEGV, [](int) {
      const char line[] = "handled before\n";
      if (write(STDERR_FILENO, line, sizeof line - 1) > 0) _exit(0);
    });
    const OverflowReport report;
    const StackPool stacks(1, 16 * 1024, 100);
    raise(SIGSEGV);
  });
  CHECK_FALSE(end.by_signal);
  CHECK(end.standard_error == "handled before\n");
}
