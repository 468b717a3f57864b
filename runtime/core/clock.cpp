#include "runtime/core/clock.hpp"

#include <time.h>

#include <chrono>

namespace luxodus {

Nanoseconds SystemClock::now() const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

Nanoseconds SystemClock::processor() const {
  timespec taken{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &taken);
  return seconds(taken.tv_sec) + taken.tv_nsec;
}

}  // namespace luxodus
