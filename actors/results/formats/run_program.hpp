// Runs external programs that make a file: a browser that prints, an encoder of films. They are
// child processes without input; their output is kept for error messages. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// Runs a program found on the path, in `folder` or, if that is empty, in the current folder. Its
/// output goes into the file `said`. Returns its exit code; -1 if it does not exist.
/// Errors: it cannot be started, or ends by a signal.
Result<int> run_program(const std::vector<std::string>& words, const std::filesystem::path& said,
                        const std::filesystem::path& folder = {});

/// ", which said: " and the end of such a file; "" if the program wrote nothing.
std::string last_words(const std::filesystem::path& said);

}  // namespace luxodus
