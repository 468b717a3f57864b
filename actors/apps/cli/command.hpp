// What all commands share: exit codes, and messages on standard error. One thread.
#pragma once

#include <string>

#include "actors/results/run/default_threads.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::cli {

enum ExitCode : int { success = 0, failure = 1, bad_input = 2, interrupted = 130 };

/// One line "file:line: sentence" on standard error.
void tell(const Problem& problem);
/// One line "file:line: warning: sentence" on standard error.
void warn(const Problem& warning);

/// The exit code of a command that a problem has ended: `bad_input` for what a person has to mend
/// in a file or in the command line, a named file that is not there among it; else `failure`. No
/// other place decides it.
ExitCode exit_code_of(ProblemKind kind);

/// The exit code of what a command did; its problem is told.
int exit_code_of(const Problem& problem);
int exit_code_of(const Result<ExitCode>& result);
int exit_code_of(const Result<void>& result);

}  // namespace luxodus::cli
