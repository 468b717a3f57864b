// A random scene file from a number: mostly well-formed TOML, in which keys are removed,
// duplicated, given invalid values, or added from the schema. A pure function of the number; any
// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/random/check_scene.hpp"

namespace luxodus::test {

std::string random_text(uint64_t number);

/// Writes the text to `file` and reads it as a scene: it is accepted, and then checked like any
/// other (unless it is too large for a test), or refused with files and lines.
Verdict check_text(uint64_t number, const std::filesystem::path& file, const EmbreeDevice& device);

}  // namespace luxodus::test
