// Numbers with standard errors. Errors are propagated to first order, as of independent samples.
// Pure functions; any thread.
#pragma once

#include <cmath>

namespace luxodus {

/// A number with its standard error.
struct Uncertain {
  double value = 0;
  double error = 0;
};

inline Uncertain plus(const Uncertain& a, const Uncertain& b) {
  return {a.value + b.value, std::hypot(a.error, b.error)};
}
inline Uncertain minus(const Uncertain& a, const Uncertain& b) {
  return {a.value - b.value, std::hypot(a.error, b.error)};
}
inline Uncertain times(double factor, const Uncertain& a) {
  return {factor * a.value, std::abs(factor) * a.error};
}
inline Uncertain product(const Uncertain& a, const Uncertain& b) {
  return {a.value * b.value, std::hypot(a.value * b.error, a.error * b.value)};
}

}  // namespace luxodus
