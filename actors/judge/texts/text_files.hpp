// The files of texts, embedded in the program by CMake (text_files.cpp.in). Constant data; any
// thread.
#pragma once

#include <string_view>

namespace luxodus {

/// The content of "en.toml" for "en". Requires: a language that has a file (else it throws).
std::string_view text_file(std::string_view language);

}  // namespace luxodus
