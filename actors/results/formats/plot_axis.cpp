#include "actors/results/formats/plot_axis.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "runtime/core/output_text.hpp"

namespace luxodus {
namespace {

// Tolerance of positions, in steps, so that rounding does not lose ticks at the ends.
constexpr double slack = 1e-6;

double power10(int exponent) {
  return std::pow(10.0, exponent);
}

/// A multiple of a step as text, without digits from rounding.
std::string step_label(double value, double step) {
  const int exponent = static_cast<int>(std::floor(std::log10(step) + slack));
  if (std::max(std::abs(value), step) >= 1e6 || step < 1e-5) return readable_number(value, 6);
  std::array<char, 40> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value),
                                 std::chars_format::fixed, std::max(0, -exponent));
  const std::string digits(buffer.data(), end.ptr);
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? "−" : "") + digits;
}

}  // namespace

double round_down_125(double value) {
  const double decade = power10(static_cast<int>(std::floor(std::log10(value) + 1e-12)));
  const double mantissa = value / decade;
  return decade * (mantissa >= 5 - slack ? 5 : mantissa >= 2 - slack ? 2 : 1);
}

double round_up_125(double value) {
  const double decade = power10(static_cast<int>(std::floor(std::log10(value) + 1e-12)));
  const double mantissa = value / decade;
  return decade * (mantissa <= 1 + slack   ? 1
                   : mantissa <= 2 + slack ? 2
                   : mantissa <= 5 + slack ? 5
                                           : 10);
}

std::vector<AxisTick> linear_ticks(double low, double high, int about) {
  const double step = round_up_125((high - low) / std::max(about, 1) * 0.75);
  std::vector<AxisTick> ticks;
  const double first = std::ceil(low / step - slack);
  const double last = std::floor(high / step + slack);
  for (double i = first; i <= last && ticks.size() < 1000; ++i) {
    ticks.push_back({i * step, step_label(i * step, step)});
  }
  return ticks;
}

std::vector<AxisTick> log_ticks(double low, double high, int max_labels) {
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-12));
  const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-12));
  const double decades = std::log10(high) - std::log10(low);
  const int every =
      std::max(1, static_cast<int>(std::ceil((last - first + 1) / double(max_labels))));
  // One notation per axis: powers as soon as one label would be long.
  const bool plain = first >= -3 && last <= 5;
  std::vector<AxisTick> ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int mantissa = 1; mantissa <= 9; ++mantissa) {
      const double value = mantissa * power10(exponent);
      if (value < low * (1 - slack) || value > high * (1 + slack)) continue;
      AxisTick tick{value, ""};
      if (mantissa == 1 && (exponent - first) % every == 0) {
        tick.label = plain ? readable_number(value) : power_of_ten(exponent);
      } else if (decades < 2 && (mantissa == 2 || mantissa == 5 || decades < 0.7)) {
        tick.label = readable_number(value);
      } else if (every > 1 && (mantissa != 1 || every > 9)) {
        continue;  // this many decades leave no room for ticks between them
      }
      ticks.push_back(std::move(tick));
    }
  }
  return ticks;
}

}  // namespace luxodus
