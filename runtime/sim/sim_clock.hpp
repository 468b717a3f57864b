// A simulated node's clock: within a turn it advances only by the work charged. Thread rule: the
// simulation's thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "runtime/core/clock.hpp"

namespace luxodus {

/// Kinds of work that a simulated node is charged for.
enum class Spent : uint8_t { other, tracing, building, frames, resting };

class SimClock final : public Clock {
 public:
  Nanoseconds now() const override { return now_; }
  Nanoseconds processor() const override { return busy_; }
  /// Advances to the world's time; the clock may be ahead while the node is busy with charged work.
  void reach(Nanoseconds moment) { now_ = std::max(now_, moment); }
  /// Charges work of this duration on a machine of speed 1.
  void charge(Nanoseconds work, Spent what = Spent::other) {
    const auto taken = static_cast<Nanoseconds>(slowness_ * static_cast<double>(work));
    now_ += taken;
    busy_ += taken;
    by_work_[static_cast<size_t>(what)] += taken;
  }
  /// All charged time so far.
  Nanoseconds busy() const { return busy_; }
  /// Charged time of one kind of work.
  Nanoseconds busy(Spent what) const { return by_work_[static_cast<size_t>(what)]; }
  /// 1: as fast as the machine on which costs were measured.
  void set_slowness(double factor) { slowness_ = factor; }

 private:
  Nanoseconds now_ = 0;
  Nanoseconds busy_ = 0;
  std::array<Nanoseconds, 5> by_work_{};
  double slowness_ = 1;
};

}  // namespace luxodus
