// A scene file of any kind from a number: well-formed TOML (but for a few), in which keys are
// taken away, doubled, given what no scene has, or added from the schema. A pure function of the
// number; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/random/check_scene.hpp"

namespace luxodus::test {

std::string random_text(uint64_t number);

/// Writes the text to `file` and reads it as a scene: it is taken, and then checked as any other
/// (unless it asks for more than a test can give), or refused with files and lines.
Verdict check_text(uint64_t number, const std::filesystem::path& file, const EmbreeDevice& device);

}  // namespace luxodus::test
