// Places ticks of an axis and labels them; shared by every picture with axes. Pure functions; any
// thread.
#pragma once

#include <string>
#include <vector>

namespace luxodus {

struct AxisTick {
  double value = 0;
  std::string label;  // empty for a minor tick
};

/// Ticks at multiples of 1, 2 or 5 times a power of ten within [low, high], about `about` of them
/// (never more than about twice). Requires: low < high, finite.
std::vector<AxisTick> linear_ticks(double low, double high, int about);

/// Ticks of a logarithmic axis: every power of ten with a label (every n-th if there are more than
/// `max_labels`), and 2..9 between them without; over less than two decades 2 and 5 have labels,
/// too. Requires: 0 < low < high, finite.
std::vector<AxisTick> log_ticks(double low, double high, int max_labels = 9);

/// The largest number 1, 2 or 5 times a power of ten that is <= value, the smallest >= value.
/// Requires: value > 0, finite.
double round_down_125(double value);
double round_up_125(double value);

}  // namespace luxodus
