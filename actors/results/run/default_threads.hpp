// How many threads trace where nobody says. Any thread.
#pragma once

#include <algorithm>
#include <thread>

namespace luxodus {

/// As many as there are processors.
inline int default_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace luxodus
