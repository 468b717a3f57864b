// How long answers of one node take, and so how long to wait for one: three times what 99 of 100
// did not pass. Old answers are forgotten by halves, so that a route which changes is learnt again.
// Only questions that were asked once teach anything, since of two it is unknown which was answered
// (Karn and Partridge, "Improving round-trip time estimates in reliable transport protocols",
// SIGCOMM 1987); until one of these is answered in time, waits that were too short stay doubled
// (RFC 6298, section 5). Plain value, 130 bytes; one node's thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/core/clock.hpp"

namespace luxodus {

struct TimeoutLimits {
  Nanoseconds floor = milliseconds(50);  // above a stall and a build on the other node's thread
  Nanoseconds first = seconds(1);        // while nothing is known of the route
  // A silent link is down after 2 s; in 5 s a slow one of 100 Mb/s brings 60 MB.
  Nanoseconds most = seconds(5);
};

class RouteDelay {
 public:
  /// A question that was asked once has its answer, after `delay`.
  void answered(Nanoseconds delay);
  /// A question that was asked at `asked` has none in time. Of many at once the first one counts.
  void timed_out(Nanoseconds asked, Nanoseconds now);

  /// How long to wait for the answer when a question is asked for the nth time. Requires: nth >= 1.
  Nanoseconds timeout(const TimeoutLimits& limits, unsigned nth) const;

  /// What 99 of 100 answers did not pass, to the next half power of two; 0 where none is known.
  Nanoseconds p99() const;

 private:
  // Two bins for each power of two of microseconds: 134 s and above share the last.
  static constexpr size_t max_powers = 27;
  static constexpr size_t bins = 2 * max_powers + 2;
  static constexpr uint32_t remembered = 512;  // answers, so that the 99th of 100 is told apart
  static constexpr unsigned max_doublings = 16;

  static size_t bin_of(Nanoseconds delay);
  static Nanoseconds end_of(size_t bin);

  std::array<uint16_t, bins> counts_{};
  uint32_t total_ = 0;
  unsigned doublings_ = 0;
  Nanoseconds doubled_at_ = 0;
};

}  // namespace luxodus
