#include "runtime/toml/document.hpp"

#include <toml++/toml.h>

#include <sstream>

#include "runtime/toml/text_scan.hpp"

namespace luxodus::toml {

namespace {

/// Place of a value; its table's place if the parser gives it no line.
Origin origin_of(const ::toml::node& node, Origin outer) {
  const auto line = static_cast<int>(node.source().begin.line);
  return {outer.file, line > 0 ? line : outer.line};
}

template <class T>
Moment moment_of(const T& said, bool is_date) {
  std::ostringstream text;
  text << said;
  return {text.str(), is_date};
}

Value value_of(const ::toml::node& node, Origin outer);

/// The parser's tables are sorted by key, and so are these.
Table table_of(const ::toml::table& table, Origin origin) {
  std::vector<Entry> entries;
  entries.reserve(table.size());
  for (auto&& [key, node] : table) {
    const auto line = static_cast<int>(key.source().begin.line);
    Value value = value_of(node, origin);
    const int own_line = line > 0 ? line : value.place().line;
    entries.push_back({std::string(key.str()), own_line, std::move(value)});
  }
  return {origin, std::move(entries)};
}

/// Recursive: text_scan.hpp bounds the depth.
Value value_of(const ::toml::node& node, Origin outer) {
  const Origin origin = origin_of(node, outer);
  if (const auto* table = node.as_table()) return {origin, table_of(*table, origin)};
  if (const auto* array = node.as_array()) {
    List list;
    list.reserve(array->size());
    for (const ::toml::node& entry : *array) list.push_back(value_of(entry, origin));
    return {origin, std::move(list)};
  }
  if (const auto* text = node.as_string()) return {origin, text->get()};
  if (const auto* whole = node.as_integer()) return {origin, whole->get()};
  if (const auto* real = node.as_floating_point()) return {origin, real->get()};
  if (const auto* flag = node.as_boolean()) return {origin, flag->get()};
  if (const auto* date = node.as_date()) return {origin, moment_of(date->get(), true)};
  if (const auto* time = node.as_time()) return {origin, moment_of(time->get(), false)};
  return {origin, moment_of(node.as_date_time()->get(), false)};
}

}  // namespace

Result<Document> parse(std::string_view text, const std::string& file, size_t max_bytes,
                       QuotePolicy quoting) {
  if (text.size() > max_bytes)
    return problem_in(file, "this file is longer than " + std::to_string(max_bytes) +
                                " bytes, the most that is read");
  if (auto ok = check_nesting(text, file); !ok) return ok.problem();
  try {
    Document document{std::make_shared<const std::string>(file), {}};
    document.top = table_of(::toml::parse(text, file), {document.file.get(), 1});
    return document;
  } catch (const ::toml::parse_error& error) {
    const std::string why =
        quoting == QuotePolicy::allowed ? ": " + std::string(error.description()) : std::string();
    return problem_in(file, static_cast<int>(error.source().begin.line), "this is not TOML" + why);
  }
}

}  // namespace luxodus::toml
