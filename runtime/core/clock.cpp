#include "runtime/core/clock.hpp"

#include <chrono>

namespace luxodus {

Nanoseconds SystemClock::now() const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace luxodus
