// Programs of others that make a file: a browser that prints, an encoder of films. They run as a
// child with nothing to read; what they say is kept, for people to be told where they fail. Any
// thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// Runs a program found on the path, in `folder` or, where that is empty, where this process is.
/// What it says is written into the file `said`. Its exit code; -1 where it is not there.
/// Errors: it cannot be begun, or ends by a signal.
Result<int> run_program(const std::vector<std::string>& words, const std::filesystem::path& said,
                        const std::filesystem::path& folder = {});

/// ", which said: " and the end of such a file; "" where the program said nothing.
std::string last_words(const std::filesystem::path& said);

}  // namespace luxodus
