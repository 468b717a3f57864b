// Rate limit for one kind of log line, so that peers cannot flood the log. Plain value; one node's
// thread.
#pragma once

#include "runtime/core/clock.hpp"

namespace luxodus {

class OnceAMinute {
 public:
  /// Whether the line may be written now; if so, not again for a minute.
  bool may(Nanoseconds now) {
    if (now < next_) return false;
    next_ = now + seconds(60);
    return true;
  }

 private:
  Nanoseconds next_ = 0;
};

}  // namespace luxodus
