// The priority of threads that trace for a live view. Any thread may call it.
#pragma once

#include <sys/resource.h>

namespace luxodus {

/// Tracing uses all processors for minutes, and leaves them to answers that viewers wait for. On
/// Linux the priority is that of the calling thread, and of the threads that it starts.
inline void give_way_to_answers() {
  constexpr int lower = 10;
  (void)setpriority(PRIO_PROCESS, 0, lower);
}

}  // namespace luxodus
