// Blocking calls of a simulated node: its disk is memory, and takes virtual time. Thread rule: the
// simulation's thread.
#pragma once

#include <functional>
#include <utility>

#include "runtime/actor/blocking_calls.hpp"

namespace luxodus {

/// Makes a call at once, and reports its completion after a delay.
class SimulatedCalls final : public BlockingCalls {
 public:
  /// `takes` returns the delay of each call. Requires: `scheduler` outlives all delays.
  SimulatedCalls(Scheduler& scheduler, std::function<Nanoseconds()> takes)
      : scheduler_(scheduler), takes_(std::move(takes)) {}

  void begin(std::function<void()> call, const Task& done) override {
    call();
    scheduler_.timers().set(scheduler_.clock().now() + takes_(), done);
  }
  void finish() override {}

 private:
  Scheduler& scheduler_;
  std::function<Nanoseconds()> takes_;
};

}  // namespace luxodus
