#include "actors/apps/cli/command.hpp"

#include <cstdio>

namespace luxodus::cli {

void tell(const Problem& problem) {
  std::fprintf(stderr, "%s\n", problem.text().c_str());
}

void warn(const Problem& warning) {
  tell({warning.where, "warning: " + warning.what});
}

ExitCode exit_code_of(ProblemKind kind) {
  switch (kind) {
    case ProblemKind::bad_input:
    case ProblemKind::not_found:
      return ExitCode::bad_input;
    case ProblemKind::refused:
    case ProblemKind::no_room:
    case ProblemKind::lost_peer:
    case ProblemKind::system:
    case ProblemKind::bug:
      break;
  }
  return ExitCode::failure;
}

int exit_code_of(const Problem& problem) {
  tell(problem);
  return exit_code_of(problem.kind);
}

int exit_code_of(const Result<ExitCode>& result) {
  return result ? result.value() : exit_code_of(result.problem());
}

int exit_code_of(const Result<void>& result) {
  return result ? ExitCode::success : exit_code_of(result.problem());
}

}  // namespace luxodus::cli
