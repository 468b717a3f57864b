#include "scenes/scene_file/scene_schema.hpp"

#include <charconv>
#include <stdexcept>

namespace luxodus {

const std::vector<TableSpec>& scene_schema() {
  static const std::vector<TableSpec> all = [] {
    std::vector<TableSpec> tables = geometry_schema();
    for (auto& t : light_schema()) tables.push_back(std::move(t));
    for (auto& t : measure_schema()) tables.push_back(std::move(t));
    for (auto& t : assessment_schema()) tables.push_back(std::move(t));
    for (auto& t : project_schema()) tables.push_back(std::move(t));
    return tables;
  }();
  return all;
}

const TableSpec& table_spec(std::string_view name) {
  for (const TableSpec& t : scene_schema()) {
    if (t.name == name) return t;
  }
  throw std::logic_error("no table '" + std::string(name) + "' in the scene schema");
}

namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
  while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
  return s;
}

std::optional<double> number_of(std::string_view s) {
  s = trimmed(s);
  double v = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), v);
  if (error != std::errc() || end != s.data() + s.size()) return std::nullopt;
  return v;
}

}  // namespace

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

std::string schema_markdown() {
  std::string out;
  for (const TableSpec& t : scene_schema()) {
    out += "### " + std::string(t.heading) + "\n\n";
    if (t.keys.empty()) {
      out += "No further keys.\n\n";
      continue;
    }
    out += "| key | type | unit | default | range | meaning |\n|---|---|---|---|---|---|\n";
    for (const KeySpec& k : t.keys) {
      out += "| `" + std::string(k.name) + "` | " + std::string(k.type) + " | " +
             std::string(k.unit) + " | " + std::string(k.fallback) + " | " + std::string(k.range) +
             " | " + std::string(k.meaning) + " |\n";
    }
    out += "\n";
  }
  return out;
}

}  // namespace luxodus
