// Words as people write them: finds the intended word for a misspelt one, and parses sizes with
// units. Pure; any thread.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace luxodus::toml {

/// The known word at the smallest edit distance (insert, remove, replace, swap neighbours), or
/// nothing if more than a third of the word is wrong.
std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known);

/// "4096", "512 MiB", "1.5 GB" -> bytes; nothing for other texts.
std::optional<double> bytes_in(std::string_view text);

}  // namespace luxodus::toml
