#include "runtime/fiber/stack_pool.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <fstream>

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
    CHECK(span.bytes >= 30 * 1024 - 128);
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
  // What lies in the gap of 16 KB below a stack harms nobody.
  char* low = stacks.stack(3).low;
  std::memset(low - 16 * 1024, 'x', 16 * 1024);
  CHECK(stacks.canary_lives(3));
  *(low - 16 * 1024 - 1) = 'x';
  CHECK_FALSE(stacks.canary_lives(3));
  CHECK(stacks.canary_lives(2));
  // The canary is above the neighbour's stack.
  const StackSpan neighbour = stacks.stack(2);
  CHECK(neighbour.low + neighbour.bytes <= low - 16 * 1024 - 128);
}

namespace {

size_t resident_pages() {
  std::ifstream file("/proc/self/statm");
  size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident;
}

}  // namespace

TEST_CASE("a suspended fiber on a stack without a guard has one page resident",
          "[runtime][stack]") {
  constexpr size_t count = 5000;
  const size_t before = resident_pages();
  Fibers fibers({count, 64 * 1024, 2});
  size_t ready = 0;
  for (size_t i = 0; i < count; ++i)
    ready += fibers.start("waits", [&fibers] { (void)fibers.suspend("here"); }) ? 1 : 0;
  REQUIRE(ready == count);
  while (fibers.any_ready()) fibers.run_next();
  // A tenth of a page is the fiber itself and tables. Sanitizers have tables of their own.
  const size_t most = default_stack_bytes() > 64 * 1024 ? 8 * count : count * 3 / 2;
  CHECK(resident_pages() - before < most);
  fibers.cancel_all();
  while (fibers.any_ready()) fibers.run_next();
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
    if (!fibers.start("photon", [] { deep(70); })) return;
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
