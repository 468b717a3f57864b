#include "runtime/toml/schema.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "runtime/core/text.hpp"

namespace luxodus::toml {

namespace {

std::optional<double> number_of(std::string_view s) {
  s = trimmed(s);
  double v = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), v);
  if (error != std::errc() || end != s.data() + s.size()) return std::nullopt;
  return v;
}

/// The entry of this name in a list of tables or keys.
template <class List>
const auto& named(const List& list, std::string_view name) {
  const auto at =
      std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
  if (at == list.end()) throw std::logic_error("the schema has no '" + std::string(name) + "'");
  return *at;
}

std::string row_of(const KeySpec& key) {
  std::string row = "| `" + std::string(key.name) + "` | ";
  for (const auto cell : {key.type, key.unit, key.fallback, key.range})
    row += std::string(cell) + " | ";
  row += key.meaning;
  return row + " |\n";
}

}  // namespace

const TableSpec& Schema::table(std::string_view name) const {
  return named(tables, name);
}

const KeySpec& Schema::key(std::string_view of, std::string_view name) const {
  return named(table(of).keys, name);
}

const TextRule* Schema::rule_of(std::string_view type) const {
  const auto at = std::find_if(text_rules.begin(), text_rules.end(),
                               [&](const TextRule& rule) { return rule.type == type; });
  return at == text_rules.end() ? nullptr : &*at;
}

std::optional<Interval> interval_of(std::string_view range) {
  range = trimmed(range);
  if (range.size() < 5) return std::nullopt;
  const char open = range.front(), close = range.back();
  if ((open != '[' && open != '(') || (close != ']' && close != ')')) return std::nullopt;
  const size_t comma = range.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto low = number_of(range.substr(1, comma - 1));
  const auto high = number_of(range.substr(comma + 1, range.size() - comma - 2));
  if (!low || !high) return std::nullopt;
  return Interval{*low, *high, open == '(', close == ')'};
}

std::vector<std::string_view> words_of(std::string_view range) {
  std::vector<std::string_view> words;
  while (!range.empty()) {
    const size_t comma = range.find(',');
    words.push_back(trimmed(range.substr(0, comma)));
    range = comma == std::string_view::npos ? std::string_view() : range.substr(comma + 1);
  }
  return words;
}

std::string schema_markdown(const Schema& schema) {
  std::string out;
  for (const TableSpec& table : schema.tables) {
    out += "### " + std::string(table.heading) + "\n\n";
    if (table.keys.empty()) {
      out += "No further keys.\n\n";
      continue;
    }
    out += "| key | type | unit | default | range | meaning |\n|---|---|---|---|---|---|\n";
    for (const KeySpec& key : table.keys) out += row_of(key);
    out += "\n";
  }
  return out;
}

}  // namespace luxodus::toml
