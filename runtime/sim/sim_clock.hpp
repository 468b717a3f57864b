// A simulated node's clock: within a turn it moves only by what is charged for work.
// Thread rule: the simulation's thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "runtime/core/clock.hpp"

namespace luxodus {

/// What a simulated node is charged for.
enum class WorkKind : uint8_t { other, tracing, building, frames, resting };

class SimClock final : public Clock {
 public:
  Nanoseconds now() const override { return now_; }
  Nanoseconds processor() const override { return busy_; }
  /// The world's time has come to this node; it may be ahead, busy with what it was charged for.
  void reach(Nanoseconds moment) { now_ = std::max(now_, moment); }
  /// Work that takes so long on a machine of this node's speed.
  void charge(Nanoseconds work, WorkKind what = WorkKind::other) {
    const auto taken = static_cast<Nanoseconds>(slowness_ * static_cast<double>(work));
    now_ += taken;
    busy_ += taken;
    by_work_[static_cast<size_t>(what)] += taken;
  }
  /// All that was charged so far, as long as it took.
  Nanoseconds busy() const { return busy_; }
  /// Of that, for work of one kind.
  Nanoseconds busy(WorkKind what) const { return by_work_[static_cast<size_t>(what)]; }
  /// 1: as fast as what costs were measured on.
  void set_slowness(double factor) { slowness_ = factor; }

 private:
  Nanoseconds now_ = 0;
  Nanoseconds busy_ = 0;
  std::array<Nanoseconds, 5> by_work_{};
  double slowness_ = 1;
};

}  // namespace luxodus
