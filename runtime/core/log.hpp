// Logging. Sources include this instead of spdlog, whose calls cost four seconds of compile time in
// every source that makes one. main and the tests configure spdlog: destination, format, level. Any
// thread.
#pragma once

#include <fmt/core.h>

#include <string_view>

namespace luxodus {

enum class LogLevel { debug, info, warning, error };

/// Whether lines of this level are logged.
bool log_wants(LogLevel level);
/// Writes a line unformatted.
void log_line(LogLevel level, std::string_view line);

template <class... Values>
void log_formatted(LogLevel level, fmt::format_string<Values...> format, const Values&... values) {
  if (log_wants(level)) log_line(level, fmt::vformat(format, fmt::make_format_args(values...)));
}

template <class... Values>
void log_debug(fmt::format_string<const Values&...> format, const Values&... values) {
  log_formatted<const Values&...>(LogLevel::debug, format, values...);
}
template <class... Values>
void log_info(fmt::format_string<const Values&...> format, const Values&... values) {
  log_formatted<const Values&...>(LogLevel::info, format, values...);
}
template <class... Values>
void log_warning(fmt::format_string<const Values&...> format, const Values&... values) {
  log_formatted<const Values&...>(LogLevel::warning, format, values...);
}
template <class... Values>
void log_error(fmt::format_string<const Values&...> format, const Values&... values) {
  log_formatted<const Values&...>(LogLevel::error, format, values...);
}

}  // namespace luxodus
