// A look at TOML text without a parser: strings and comments aside, brackets, dots and bare words.
// Any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "runtime/toml/schema.hpp"

namespace luxodus {

namespace limits {
/// Dots of one key, and brackets open at a time; people write three. As every bracket may hold a
/// dotted key, tables nest at most 33 * 33 deep: some hundred kilobytes of stack.
inline constexpr size_t toml_nesting = 32;
}  // namespace limits

namespace toml {

/// The first line that nests deeper than limits::toml_nesting; nothing where none does. A parser
/// keeps nested tables as nested objects and takes them apart by recursion, so that without this
/// a file of a few kilobytes, a.a.a.a ... = 1, could end the program for want of stack. One pass,
/// no memory. It does not say that the text is TOML.
Result<void> check_nesting(std::string_view text, const std::string& file);

/// The text with every bare key by its oldest name, so that a hash of it stays the same where a
/// file takes up a new name. A word counts as a key in whichever table it stands.
std::string with_oldest_names(std::string_view text, const Schema& schema);

}  // namespace toml
}  // namespace luxodus
