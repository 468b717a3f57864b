// Time as the runtime knows it: nanoseconds since a start of no meaning. Everything that waits,
// times out or measures asks a Clock, so that a test or a simulation can move time by hand.
// Thread rule: a Clock belongs to the node that asks it; the system's may be asked by any.
#pragma once

#include <cstdint>

namespace luxodus {

/// A moment, or a span between two [ns]. 64 bits last 292 years.
using Nanoseconds = std::int64_t;

constexpr Nanoseconds microseconds(std::int64_t n) {
  return n * 1'000;
}
constexpr Nanoseconds milliseconds(std::int64_t n) {
  return n * 1'000'000;
}
constexpr Nanoseconds seconds(std::int64_t n) {
  return n * 1'000'000'000;
}

/// For people [s].
constexpr double seconds_in(Nanoseconds span) {
  return static_cast<double>(span) * 1e-9;
}

/// Tells the time; never goes back.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual Nanoseconds now() const = 0;
  /// Processor time of the thread that asks, since a start of no meaning; of a node whose time is
  /// virtual what it was charged.
  virtual Nanoseconds processor() const { return now(); }
};

/// The machine's monotonic clock.
class SystemClock final : public Clock {
 public:
  Nanoseconds now() const override;
  Nanoseconds processor() const override;
};

/// Stands still until it is moved: for tests and simulation.
class ManualClock final : public Clock {
 public:
  explicit ManualClock(Nanoseconds start = 0) : now_(start) {}
  Nanoseconds now() const override { return now_; }
  /// Requires: by >= 0.
  void advance(Nanoseconds by) { now_ += by; }

 private:
  Nanoseconds now_;
};

}  // namespace luxodus
