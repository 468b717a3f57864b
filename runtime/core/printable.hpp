// Text of others, for people: control characters, which a name or a file's content may carry and a
// terminal would obey, stand as \xNN. Any thread.
#pragma once

#include <string>
#include <string_view>

namespace luxodus {

/// With every control character told, those of ASCII and those that UTF-8 spells as C2 80 to C2 9F
/// (some terminals take C2 9B for "escape ["); but for those of `kept`.
std::string printable(std::string_view text, std::string_view kept = {});

/// Length of the well-formed UTF-8 sequence at the start of `text`, 0 where there is none
/// (Unicode Standard, table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF).
/// Requires: text is not empty.
size_t utf8_length(std::string_view text);

namespace limits {
/// Of a word that a message quotes: longer than any that is right.
inline constexpr size_t excerpt_bytes = 60;
}  // namespace limits

/// What a file of others says, for the quotes of a message: no longer than that, with "..." where
/// it is cut, and without what is no character: control characters and bytes that are no UTF-8
/// stand as \xNN. Every message that quotes such bytes quotes this.
std::string excerpt(std::string_view text, size_t max_bytes = limits::excerpt_bytes);

}  // namespace luxodus
