// Escapes control characters in untrusted text, which names and file contents may carry and a
// terminal would obey: they become \xNN. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

namespace luxodus {

/// Escapes every control character except those in `kept`: ASCII's, and those that UTF-8 encodes as
/// C2 80 to C2 9F (some terminals take C2 9B for "escape [").
std::string printable(std::string_view text, std::string_view kept = {});

/// Length of the well-formed UTF-8 sequence at the start of `text`, 0 if there is none (Unicode
/// Standard, table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF). Requires: text
/// is not empty.
size_t utf8_length(std::string_view text);

namespace limits {
/// Longest quotation in a message: longer than any valid word.
inline constexpr size_t excerpt_bytes = 60;
}  // namespace limits

/// Quotes untrusted file content in a message: at most `max_bytes`, with "..." where it is cut;
/// control characters and invalid UTF-8 become \xNN. Every message that quotes such bytes uses
/// this.
std::string excerpt(std::string_view text, size_t max_bytes = limits::excerpt_bytes);

}  // namespace luxodus
