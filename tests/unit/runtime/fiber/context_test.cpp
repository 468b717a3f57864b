#include "runtime/fiber/context.hpp"

#include <xmmintrin.h>

#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/fiber/stack_pool.hpp"

using namespace luxodus;

namespace {

/// One execution with a place for its notes.
struct Execution {
  Execution(StackPool& stacks, size_t index, Context::Entry entry) {
    context.prepare(stacks.stack(index), entry, this);
  }
  Context context;
  std::string name;
  std::string noted;
  unsigned int control = 0;
};

/// Throws its own name, leaves within the handler, and rethrows when entered again.
void rethrow_after_leaving(void* argument) {
  auto& self = *static_cast<Execution*>(argument);
  try {
    try {
      throw std::runtime_error(self.name);
    } catch (...) {
      self.context.leave();
      throw;
    }
  } catch (const std::exception& e) {
    self.noted = e.what();
  }
  for (;;) self.context.leave();
}

}  // namespace

TEST_CASE("executions that leave within catch blocks rethrow their own exceptions",
          "[runtime][context]") {
  StackPool stacks(2, default_stack_bytes(), 100);
  Execution a(stacks, 0, rethrow_after_leaving);
  Execution b(stacks, 1, rethrow_after_leaving);
  a.name = "A";
  b.name = "B";
  a.context.enter();
  CHECK_FALSE(exception_in_flight());
  b.context.enter();
  a.context.enter();
  b.context.enter();
  CHECK(a.noted == "A");
  CHECK(b.noted == "B");
  CHECK_FALSE(exception_in_flight());
}

TEST_CASE("the caller of enter in a catch block still handles its own exception",
          "[runtime][context]") {
  StackPool stacks(1, default_stack_bytes(), 100);
  Execution a(stacks, 0, rethrow_after_leaving);
  a.name = "A";
  std::string kept;
  try {
    try {
      throw std::runtime_error("outside");
    } catch (...) {
      a.context.enter();
      a.context.enter();
      CHECK(exception_in_flight());
      throw;
    }
  } catch (const std::exception& e) {
    kept = e.what();
  }
  CHECK(kept == "outside");
  CHECK(a.noted == "A");
}

TEST_CASE("floating-point control starts as the maker's and then belongs to the execution",
          "[runtime][context]") {
  constexpr unsigned int flush_to_zero = 0x8000;
  const unsigned int before = _mm_getcsr();
  StackPool stacks(1, default_stack_bytes(), 100);
  _mm_setcsr(before | flush_to_zero);
  Execution a(stacks, 0, [](void* argument) {
    auto& self = *static_cast<Execution*>(argument);
    self.control = _mm_getcsr();
    _mm_setcsr(self.control & ~flush_to_zero);
    self.context.leave();
    self.control = _mm_getcsr();
    for (;;) self.context.leave();
  });
  a.context.enter();
  CHECK((a.control & flush_to_zero) != 0);
  CHECK((_mm_getcsr() & flush_to_zero) != 0);
  a.context.enter();
  CHECK((a.control & flush_to_zero) == 0);
  CHECK((_mm_getcsr() & flush_to_zero) != 0);
  _mm_setcsr(before);
}
