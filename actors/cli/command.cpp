#include "actors/cli/command.hpp"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "runtime/core/log.hpp"

namespace luxodus::cli {

void tell(const Problem& problem) {
  std::fprintf(stderr, "%s\n", problem.text().c_str());
}

void warn(const std::string& text) {
  log_warning("{}", text);
}

int exit_code_of(const Result<ExitCode>& result) {
  if (result.ok()) return result.value();
  tell(result.problem());
  return ExitCode::bad_input;
}

int exit_code_of(const Result<void>& result) {
  return exit_code_of(result.ok() ? Result(ExitCode::success) : Result<ExitCode>(result.problem()));
}

int default_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace luxodus::cli
