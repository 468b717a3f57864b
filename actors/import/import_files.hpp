// What the kinds of `luxodus import` share: quoting of file names in the files that they write, and
// the folder that they write to. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"

namespace luxodus {

/// `file` quoted as a scene in `folder` names it.
/// Errors: a path that would end the quoted text.
Result<std::string> quoted_from(const std::filesystem::path& folder,
                                const std::filesystem::path& file);

/// A text quoted for TOML, without characters that would end it.
std::string toml_text(std::string_view text);

/// A text as a name in a scene: at most 120 characters, without characters that names must not
/// have.
std::string as_name(std::string_view text, std::string_view otherwise);

/// The folder `out`, made if missing.
Result<std::filesystem::path> import_folder(const std::string& out);

/// Writes a file that the user goes on with, unless it exists. Returns whether it was kept.
Result<bool> write_unless_there(const std::filesystem::path& file, const std::string& text);

}  // namespace luxodus
