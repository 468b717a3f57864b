#include "runtime/toml/value.hpp"

#include <algorithm>
#include <array>

namespace luxodus::toml {

Table::Table(Origin origin, std::vector<Entry> entries)
    : origin_(origin), entries_(std::move(entries)) {}

const Value* Table::find(std::string_view key) const {
  const auto at = std::lower_bound(
      entries_.begin(), entries_.end(), key,
      [](const Entry& entry, std::string_view wanted) { return entry.key < wanted; });
  return at != entries_.end() && at->key == key ? &at->value : nullptr;
}

Table Table::over(const Table& base) const {
  std::vector<Entry> all = entries_;
  for (const Entry& entry : base.entries_)
    if (find(entry.key) == nullptr) all.push_back(entry);
  std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  return {origin_, std::move(all)};
}

std::string_view Value::kind() const {
  constexpr std::array<std::string_view, std::variant_size_v<Data>> kinds{
      "a table", "an array", "a text", "an integer", "a number", "true or false", "a date or time"};
  return kinds[data_.index()];
}

std::optional<double> Value::as_number() const {
  if (const auto* whole = as_integer()) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&data_)) return *real;
  return std::nullopt;
}

}  // namespace luxodus::toml
