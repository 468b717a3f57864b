#include "actors/apps/cli/command.hpp"

#include <cstdio>

namespace luxodus::cli {

void tell(const Problem& problem) {
  std::fprintf(stderr, "%s\n", problem.text().c_str());
}

void warn(const Problem& warning) {
  tell({warning.where, "warning: " + warning.what});
}

int exit_code_of(const Result<ExitCode>& result) {
  if (result) return result.value();
  tell(result.problem());
  return ExitCode::bad_input;
}

int exit_code_of(const Result<void>& result) {
  return exit_code_of(result ? Result(ExitCode::success) : Result<ExitCode>(result.problem()));
}

}  // namespace luxodus::cli
