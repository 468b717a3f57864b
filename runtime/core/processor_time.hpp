// CPU time as the system counts it, which other processes disturb least. For measuring; results
// never depend on it. Any thread.
#pragma once

#include <time.h>

namespace luxodus {

/// Time of a system clock [s].
inline double clock_seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU time of the calling thread [s].
inline double thread_seconds() {
  return clock_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/// CPU time of this thread since thread_seconds() was `start` [ns].
inline double thread_nanoseconds_since(double start) {
  return 1e9 * (thread_seconds() - start);
}

}  // namespace luxodus
