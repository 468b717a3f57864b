// Lets one line of a kind into the log each minute: what comes from outside cannot fill it.
// Plain value; one node's thread.
#pragma once

#include "runtime/core/clock.hpp"

namespace luxodus {

class OnceAMinute {
 public:
  /// Whether the line may be written now; then no other may for a minute.
  bool may(Nanoseconds now) {
    if (now < next_) return false;
    next_ = now + seconds(60);
    return true;
  }

 private:
  Nanoseconds next_ = 0;
};

}  // namespace luxodus
