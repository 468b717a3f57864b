// What the kinds of `luxodus import` share: how a file is named in what they write, and the folder
// they write to.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"

namespace luxodus {

/// `file` as a scene in `folder` names it, with quotes.
/// Errors: a path that TOML would take for the end of a text.
Result<std::string> quoted_from(const std::filesystem::path& folder,
                                const std::filesystem::path& file);

/// A text as TOML has it: with quotes, and without what would end it.
std::string toml_text(std::string_view text);

/// A text as a name of a scene: at most 120 characters, without what names must not have.
std::string as_name(std::string_view text, std::string_view otherwise);

/// The folder `out`, made where there is none.
Result<std::filesystem::path> import_folder(const std::string& out);

/// Writes a file that a person goes on with, only where there is none. Whether it was kept.
Result<bool> write_unless_there(const std::filesystem::path& file, const std::string& text);

}  // namespace luxodus
