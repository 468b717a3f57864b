// Clocks, memory as the system sees it, and the summary of repeated measurements. Any thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "runtime/core/processor_time.hpp"

namespace luxodus::bench {

inline double wall_seconds() {
  return clock_seconds(CLOCK_MONOTONIC);
}

/// CPU time of all threads of this process [s].
inline double process_seconds() {
  return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

/// A line of /proc/self/status [bytes], e.g. "VmRSS" or "VmHWM"; 0 if it is missing.
inline int64_t process_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return 1024 * std::stoll(line.substr(key.size() + 1));
  }
  return 0;
}

struct Summary {
  double median = 0, low = 0, high = 0;
};
/// Requires: at least one value.
inline Summary summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

}  // namespace luxodus::bench
