// Scans TOML text without a parser: skips strings and comments and looks at brackets, dots and bare
// words. Pure; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "runtime/toml/schema.hpp"

namespace luxodus {

namespace limits {
/// Limit of dots in one key and of open brackets; people write three. As every bracket may hold a
/// dotted key, tables nest at most 33 * 33 deep: some hundred kilobytes of stack.
inline constexpr size_t toml_nesting = 32;
}  // namespace limits

namespace toml {

/// The first line that nests deeper than limits::toml_nesting; nothing if none does. A parser
/// builds nested tables as nested objects and destroys them by recursion, so a file of a few
/// kilobytes, a.a.a.a ... = 1, could overflow its stack. One pass, no allocation. It does not check
/// that the text is TOML.
Result<void> check_nesting(std::string_view text, const std::string& file);

/// The text with every bare key replaced by its earlier name (`hashed_as`), so that its hash stays
/// the same when a key is renamed. A word counts as a key in any table.
std::string with_earlier_names(std::string_view text, const Schema& schema);

}  // namespace toml
}  // namespace luxodus
