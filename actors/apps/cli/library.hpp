// Where the files are that an installed program has with it: beside it, wherever it was unpacked.
#pragma once

#include <filesystem>
#include <string>

namespace luxodus::cli {

/// share/luxodus beside the folder of this program; nothing need be there.
std::filesystem::path shared_folder();

/// A scene as it is named on a command line: a file that is there, or one of the library that
/// ships ("office_floor", "scenes/library/office_floor.toml"). What is neither comes back as it is.
std::string find_scene(const std::string& name);

}  // namespace luxodus::cli
