// Blocking calls of a simulated node: its disk is memory, and takes virtual time.
// Thread rule: the simulation's thread.
#pragma once

#include <functional>
#include <utility>

#include "runtime/actor/blocking_calls.hpp"

namespace luxodus {

/// A call is made at once, and is done a time later.
class SimulatedCalls final : public BlockingCalls {
 public:
  /// `takes` is asked for each. Requires: `scheduler` outlives the last one's time.
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
