// Base64 (RFC 4648), for pages, messages and files that embed binary data. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace luxodus {

std::string base64(std::string_view bytes);

/// The bytes; nothing where the text is no base64. Padding may be missing.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace luxodus
