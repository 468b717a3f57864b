// Finds the files that an installed program comes with: relative to it, wherever it was unpacked.
// One thread.
#pragma once

#include <filesystem>
#include <string>

namespace luxodus::cli {

/// share/luxodus beside the folder of this program; it need not exist.
std::filesystem::path shared_folder();

/// A scene named on a command line: an existing file, or a scene of the library that ships
/// ("office_floor", "scenes/library/office_floor.toml"). Any other name is returned unchanged.
std::string find_scene(const std::string& name);

}  // namespace luxodus::cli
