// Response times of one node, and the timeout that follows: three times the 99th percentile. Counts
// are halved repeatedly, so that a route which changes is learnt again. Only requests sent once are
// measured, since with retries it is unknown which copy was answered (Karn and Partridge,
// "Improving round-trip time estimates in reliable transport protocols", SIGCOMM 1987); until one
// of these is answered in time, doubled timeouts stay (RFC 6298, section 5). Plain value, 130
// bytes; one node's thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/core/clock.hpp"

namespace luxodus {

struct TimeoutLimits {
  // longer than a stall and a build on the other node's thread
  Nanoseconds floor = milliseconds(50);
  Nanoseconds first = seconds(1);  // while the route is unknown
  // A silent link is down after 2 s; in 5 s a slow one of 100 Mb/s brings 60 MB.
  Nanoseconds most = seconds(5);
};

class RouteDelay {
 public:
  /// A request sent once was answered after `delay`.
  void answered(Nanoseconds delay);
  /// A request sent at `asked` timed out. Of many at once only the first counts.
  void timed_out(Nanoseconds asked, Nanoseconds now);

  /// The timeout of the nth request. Requires: nth >= 1.
  Nanoseconds timeout(const TimeoutLimits& limits, unsigned nth) const;

  /// 99th percentile of delays, rounded up to a half power of two; 0 if none is known.
  Nanoseconds p99() const;

 private:
  // Two bins for each power of two of microseconds: 134 s and above share the last.
  static constexpr size_t max_powers = 27;
  static constexpr size_t bins = 2 * max_powers + 2;
  static constexpr uint32_t remembered = 512;  // answers, enough to resolve the 99th percentile
  static constexpr unsigned max_doublings = 16;

  static size_t bin_of(Nanoseconds delay);
  static Nanoseconds end_of(size_t bin);

  std::array<uint16_t, bins> counts_{};
  uint32_t total_ = 0;
  unsigned doublings_ = 0;
  Nanoseconds doubled_at_ = 0;
};

}  // namespace luxodus
