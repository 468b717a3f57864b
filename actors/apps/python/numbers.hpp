// Checks numbers given from Python. Errors (Refused): not finite, out of range, not whole. Pure;
// any thread.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "actors/apps/python/errors.hpp"

namespace luxodus::limits {
/// Threads of one run, as in `luxodus run`.
inline constexpr int threads = 1024;
}  // namespace luxodus::limits

namespace luxodus::python {

/// Above `low`, up to `high`.
inline double between(const char* name, double value, double low, double high) {
  if (!(value > low && value <= high))
    throw Refused(
        problem(fmt::format("{} is {}: it must be above {}, up to {}", name, value, low, high)));
  return value;
}

/// Whole, from `low` to `high`; 1e6 is accepted.
inline int64_t whole_between(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high) || value != std::floor(value))
    throw Refused(problem(
        fmt::format("{} is {}: it must be a whole number from {} to {}", name, value, low, high)));
  return static_cast<int64_t>(value);
}

}  // namespace luxodus::python
