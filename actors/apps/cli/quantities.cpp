#include "actors/apps/cli/quantities.hpp"

#include <fmt/core.h>

#include <cmath>
#include <exception>

namespace luxodus::cli {

namespace {

/// Splits a number from the text after it.
bool split_number(const std::string& text, double& value, std::string& rest) {
  try {
    size_t used = 0;
    value = std::stod(text, &used);
    rest = text.substr(used);
  } catch (const std::exception&) {
    return false;
  }
  return std::isfinite(value);
}

Problem not_understood(const char* what, const std::string& text, const char* examples) {
  return {{},
          std::string(what) + " \"" + text + "\" is not understood; write for example " + examples};
}

}  // namespace

Result<int64_t> parse_count(const std::string& text) {
  const Problem problem = not_understood("the count", text, "1000000, 1e6, 250k, 10M or 2G");
  double value = 0;
  std::string rest;
  if (!split_number(text, value, rest)) return problem;
  if (rest == "k")
    value *= 1e3;
  else if (rest == "M")
    value *= 1e6;
  else if (rest == "G")
    value *= 1e9;
  else if (!rest.empty())
    return problem;
  if (!(value >= 1 && value <= 1e15)) return problem;
  return static_cast<int64_t>(std::ceil(value));
}

Result<double> parse_share(const std::string& text) {
  const Problem problem = not_understood("the error", text, "1% or 0.01");
  double value = 0;
  std::string rest;
  if (!split_number(text, value, rest)) return problem;
  if (rest == "%")
    value /= 100;
  else if (!rest.empty())
    return problem;
  if (!(value > 0 && value < 1)) return problem;
  return value;
}

Result<double> parse_time(const std::string& text) {
  const Problem problem = not_understood("the time", text, "90, 60s, 5m, 1h or 0s");
  double value = 0;
  std::string rest;
  if (!split_number(text, value, rest)) return problem;
  if (rest == "ms")
    value *= 1e-3;
  else if (rest == "m")
    value *= 60;
  else if (rest == "h")
    value *= 3600;
  else if (!rest.empty() && rest != "s")
    return problem;
  if (!(std::abs(value) < 1e8)) return problem;
  return value;
}

Result<void> check_time(const std::string& text) {
  const auto seconds = parse_time(text);
  return seconds ? Result<void>() : seconds.problem();
}

Result<double> parse_seconds(const std::string& text) {
  const auto time = parse_time(text);
  if (time && time.value() > 0) return time;
  return not_understood("the time", text, "90, 60s, 5m, 1h or 1ms");
}

std::string short_number(double v) {
  const char* unit = "";
  if (v >= 1e9) {
    v /= 1e9;
    unit = " G";
  } else if (v >= 1e6) {
    v /= 1e6;
    unit = " M";
  } else if (v >= 1e3) {
    v /= 1e3;
    unit = " k";
  }
  return fmt::format("{:.3g}{}", v, unit);
}

std::string time_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 100 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace luxodus::cli
