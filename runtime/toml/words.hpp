// Words as people write them: finds the intended word for a misspelt one, and parses sizes with
// units. Pure; any thread.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace luxodus::toml {

/// The nearest of these words, or nothing where none is near enough to be what was meant. Near are
/// few steps: insert, remove, replace, swap neighbours. `max_steps`: else a third of the word may
/// be wrong, or all behind the first half where one known word alone begins so.
std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known,
                                             std::optional<size_t> max_steps = std::nullopt);

/// "4096", "512 MiB", "1.5 GB" -> bytes; nothing for other texts.
std::optional<double> bytes_in(std::string_view text);

}  // namespace luxodus::toml
