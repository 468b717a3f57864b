// The files of texts, which CMake puts into the program (text_files.cpp.in). Constant data; any
// thread.
#pragma once

#include <string_view>

#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// The text of en.toml, de.toml or fr.toml.
std::string_view text_file(Language language);

}  // namespace luxodus
