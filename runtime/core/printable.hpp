// Text of others, for a terminal: control characters, which a name or a file's content may carry
// and a terminal would obey, stand as \xNN. Any thread.
#pragma once

#include <string>
#include <string_view>

namespace luxodus {

/// With every control character told, those of ASCII and those that UTF-8 spells as C2 80 to C2 9F
/// (some terminals take C2 9B for "escape ["); but for those of `kept`.
std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace luxodus
