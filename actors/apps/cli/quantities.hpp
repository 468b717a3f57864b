// Parses and prints counts, shares and times. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// "1e6", "250k", "10M", "2G" -> a count; "1%", "0.01" -> a share; "90", "60s", "5m", "1h" ->
/// seconds.
Result<int64_t> parse_count(const std::string& text);
Result<double> parse_share(const std::string& text);
Result<double> parse_seconds(const std::string& text);
/// Parses a point in time, which may be zero or negative.
Result<double> parse_time(const std::string& text);
/// Whether a text is a time, as options ask it.
Result<void> check_time(const std::string& text);

/// "1.23 M", "45.6 k".
std::string short_number(double v);

/// "45 s", "12 min", "3.4 h".
std::string time_text(double seconds);

}  // namespace luxodus::cli
