// The default number of threads that trace. Any thread.
#pragma once

#include <algorithm>
#include <thread>

namespace luxodus {

/// The number of processors.
inline int default_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace luxodus
