// A look at TOML text before a parser sees it. A parser keeps nested tables as nested objects and
// takes them apart by recursion, so a file of a few kilobytes, a.a.a.a ... = 1, could end the
// program for want of stack. This bounds the depth; it does not say that the text is TOML.
// Any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Dots of one key, and brackets open at a time; people write three. As every bracket may hold a
/// dotted key, tables nest at most 33 * 33 deep: some hundred kilobytes of stack.
inline constexpr size_t toml_nesting = 32;
}  // namespace limits

/// The first line that nests deeper than limits::toml_nesting; nothing where none does. One pass,
/// no memory. Strings and comments do not count.
std::optional<Problem> too_deep_toml(std::string_view text, const std::string& file);

}  // namespace luxodus
