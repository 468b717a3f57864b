#include "runtime/core/log.hpp"

#include <spdlog/spdlog.h>

namespace luxodus {

namespace {

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      break;
  }
  return spdlog::level::err;
}

}  // namespace

bool log_wants(LogLevel level) {
  return spdlog::should_log(level_of(level));
}

void log_line(LogLevel level, std::string_view line) {
  spdlog::log(level_of(level), spdlog::string_view_t(line.data(), line.size()));
}

}  // namespace luxodus
