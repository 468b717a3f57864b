// The files of texts, embedded in the program by CMake (text_files.cpp.in). Constant data; any
// thread.
#pragma once

#include <string_view>

#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// The content of en.toml, de.toml or fr.toml.
std::string_view text_file(Language language);

}  // namespace luxodus
