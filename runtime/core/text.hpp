// Small operations on text that readers of file formats share. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace luxodus {

/// The text without these characters at its beginning and end.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r\n");

/// Adds a character as UTF-8; U+FFFD for 0, a surrogate and what is beyond U+10FFFF.
void append_utf8(std::string& out, uint32_t code);

}  // namespace luxodus
