#include "runtime/toml/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <string>
#include <utility>

namespace luxodus::toml {

namespace {

/// Longer words are not typing errors; the bound also keeps the search cheap.
constexpr size_t max_misspelt_chars = 200;

/// Optimal string alignment: three rows suffice, as a swap looks two rows back.
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> before, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

/// Letters that two words begin with alike.
size_t common_beginning(std::string_view a, std::string_view b) {
  const auto [end, ignored] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return static_cast<size_t>(end - a.begin());
}

/// The only word of these that begins like `word` for at least half of either: "reflectivity" for
/// "reflectance".
std::optional<std::string_view> word_of_same_stem(std::string_view word,
                                                  const std::vector<std::string_view>& known) {
  constexpr size_t least_letters = 5;
  std::optional<std::string_view> found;
  for (const auto candidate : known) {
    const size_t common = common_beginning(word, candidate);
    if (common < least_letters || 2 * common < std::max(word.size(), candidate.size())) continue;
    if (found) return std::nullopt;
    found = candidate;
  }
  return found;
}

}  // namespace

std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known,
                                             std::optional<size_t> max_steps) {
  if (word.size() > max_misspelt_chars) return std::nullopt;
  std::optional<std::string_view> nearest;
  size_t too_far = max_steps.value_or(word.size() / 3) + 1;
  for (const auto candidate : known) {
    const size_t steps = distance(word, candidate);
    // A word with nothing in common was not meant.
    if (steps >= std::min(too_far, candidate.size())) continue;
    too_far = steps;
    nearest = candidate;
  }
  if (!nearest && !max_steps) return word_of_same_stem(word, known);
  return nearest;
}

std::optional<double> bytes_in(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 9> units{{{"", 1},
                                                                      {"KiB", 0x1p10},
                                                                      {"MiB", 0x1p20},
                                                                      {"GiB", 0x1p30},
                                                                      {"TiB", 0x1p40},
                                                                      {"KB", 1e3},
                                                                      {"MB", 1e6},
                                                                      {"GB", 1e9},
                                                                      {"TB", 1e12}}};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  if (text.size() > 1 && text.front() == ' ') text.remove_prefix(1);
  for (const auto& [unit, factor] : units) {
    if (text == unit) return value * factor;
  }
  return std::nullopt;
}

}  // namespace luxodus::toml
