// Time in the runtime: nanoseconds since an arbitrary start. Everything that waits, times out or
// measures asks a Clock, so that a test or a simulation can advance time. Thread rule: a Clock
// belongs to one node; SystemClock may be used by any thread.
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

/// In seconds, for messages.
constexpr double seconds_in(Nanoseconds span) {
  return static_cast<double>(span) * 1e-9;
}

/// Monotonic time.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual Nanoseconds now() const = 0;
  /// CPU time of the calling thread since an arbitrary start; in virtual time, what the node was
  /// charged.
  virtual Nanoseconds processor() const { return now(); }
};

/// The machine's monotonic clock.
class SystemClock final : public Clock {
 public:
  Nanoseconds now() const override;
  Nanoseconds processor() const override;
};

/// Advances only by advance(): for tests and simulation.
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
