// Reports the overflow of a fiber's stack in one line before the process ends with a core dump:
//   luxodus: fiber 17 (reader) overflowed its stack of 65536 bytes; raise stack_kb
// Other faults go to the previous handler. Thread rule: each thread that runs fibers holds one.
#pragma once

#include <memory>

namespace luxodus {

class StackPool;

/// Held by a thread while it runs fibers: a fault on a full stack can only be handled on another
/// stack, which each thread must have of its own.
class OverflowReport {
 public:
  /// Throws std::runtime_error if the system refuses.
  OverflowReport();
  OverflowReport(const OverflowReport&) = delete;
  OverflowReport& operator=(const OverflowReport&) = delete;
  ~OverflowReport();

 private:
  struct AlternateStack;
  std::unique_ptr<AlternateStack> stack_;
};

/// Registers pools with the handler. Any thread; a pool adds and removes itself.
namespace overflow_watch {
void add(const StackPool& pool);
void remove(const StackPool& pool) noexcept;
}  // namespace overflow_watch

}  // namespace luxodus
