// A simulated node's clock: within a turn it moves only by what is charged for work.
// Thread rule: the simulation's thread.
#pragma once

#include <algorithm>

#include "runtime/core/clock.hpp"

namespace luxodus {

class SimClock final : public Clock {
 public:
  Nanoseconds now() const override { return now_; }
  /// The world's time has come to this node; it may be ahead, busy with what it was charged for.
  void reach(Nanoseconds moment) { now_ = std::max(now_, moment); }
  /// Work that takes so long on a machine of this node's speed.
  void charge(Nanoseconds work) {
    const auto taken = static_cast<Nanoseconds>(slowness_ * static_cast<double>(work));
    now_ += taken;
    busy_ += taken;
  }
  /// All that was charged so far, as long as it took.
  Nanoseconds busy() const { return busy_; }
  /// 1: as fast as what costs were measured on.
  void set_slowness(double factor) { slowness_ = factor; }

 private:
  Nanoseconds now_ = 0;
  Nanoseconds busy_ = 0;
  double slowness_ = 1;
};

}  // namespace luxodus
