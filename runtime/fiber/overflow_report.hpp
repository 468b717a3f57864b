// Makes the overflow of a fiber's stack one readable line before the process ends with a core:
//   luxodus: fiber 17 (photon) overflowed its stack of 32768 bytes; raise stack_kb
// A fault elsewhere goes on to whoever handled it before.
#pragma once

#include <memory>

namespace luxodus {

class StackPool;

/// Held by a thread that runs fibers, for as long as it does: a fault on a full stack can only be
/// handled on another one, which each thread must have of its own.
class OverflowReport {
 public:
  /// Throws std::runtime_error where the system refuses.
  OverflowReport();
  OverflowReport(const OverflowReport&) = delete;
  OverflowReport& operator=(const OverflowReport&) = delete;
  ~OverflowReport();

 private:
  struct AlternateStack;
  std::unique_ptr<AlternateStack> stack_;
};

/// The pools that the handler knows. Any thread; a pool adds and removes itself.
namespace overflow_watch {
void add(const StackPool& pool);
void remove(const StackPool& pool) noexcept;
}  // namespace overflow_watch

}  // namespace luxodus
