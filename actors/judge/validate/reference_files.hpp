// The files of tests/reference as text. CMake generates the source of this header's function when
// it configures: actors/judge/validate/reference_files.cpp.in. Any thread.
#pragma once

#include <string_view>

namespace luxodus::light {

/// The whole text of a file, by its name without folder; empty where there is none.
std::string_view reference_file(std::string_view name);

}  // namespace luxodus::light
