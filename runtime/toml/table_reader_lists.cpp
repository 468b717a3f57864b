// The keys whose values are lists or tables.
#include <fmt/format.h>

#include <cmath>

#include "runtime/toml/table_reader.hpp"

namespace luxodus::toml {

const List* TableReader::list(const KeySpec& s) {
  const Value* value = wanted(s);
  if (!value) return nullptr;
  const List* list = value->as_list();
  if (!list) {
    wrong_type(s, *value, "a list");
    return nullptr;
  }
  if (list->size() <= limits::toml_values) return list;
  problem(s.name, fmt::format("'{}' has {} values; at most {} are allowed", s.name, list->size(),
                              limits::toml_values));
  return nullptr;
}

// ---- numbers -----------------------------------------------------------------------------------

std::vector<double> TableReader::numbers(std::string_view key) {
  std::vector<double> out;
  const List* values = list(spec(key, "numbers"));
  if (!values) return out;
  for (const Value& value : *values) {
    const auto v = checked(key, value);
    if (!v) return {};
    out.push_back(*v);
  }
  return out;
}

namespace {

/// The numbers of a default such as [0, 0, 1].
template <size_t N>
std::optional<std::array<double, N>> literal_components(std::string_view literal) {
  std::string text(literal);
  for (char& c : text) {
    if (c == '[' || c == ']' || c == ',') c = ' ';
  }
  std::array<double, N> out{};
  const char* at = text.c_str();
  for (double& component : out) {
    char* end = nullptr;
    component = std::strtod(at, &end);
    if (end == at) return std::nullopt;
    at = end;
  }
  return out;
}

}  // namespace

template <size_t N>
std::optional<std::array<double, N>> TableReader::components(std::string_view key,
                                                             std::string_view type) {
  const KeySpec& s = spec(key, type);
  const Value* value = wanted(s);
  if (!value) return literal_components<N>(s.fallback);
  const List* values = value->as_list();
  if (!values || values->size() != N) {
    report(value->place(),
           fmt::format("'{}' must be a list of {} numbers, not {}", key, N,
                       values ? fmt::format("of {}", values->size()) : std::string(value->kind())));
    return std::nullopt;
  }
  std::array<double, N> out{};
  for (size_t i = 0; i < N; ++i) {
    const auto v = checked(key, (*values)[i]);
    if (!v) return std::nullopt;
    out[i] = *v;
  }
  return out;
}

template <size_t N>
std::vector<std::array<double, N>> TableReader::rows(std::string_view key, std::string_view type,
                                                     size_t first_bounded) {
  static_assert(N == 2 || N == 3);
  std::vector<std::array<double, N>> out;
  const List* values = list(spec(key, type));
  if (!values) return out;
  for (const Value& value : *values) {
    const List* row = value.as_list();
    if (!row || row->size() != N) {
      report(value.place(), fmt::format("'{}' must be a list of {}", key,
                                        N == 3 ? "points [x, y, z]" : "rows of two numbers"));
      return {};
    }
    std::array<double, N>& numbers = out.emplace_back();
    for (size_t i = 0; i < N; ++i) {
      const auto v = i < first_bounded ? (*row)[i].as_number() : checked(key, (*row)[i]);
      if (i < first_bounded && !(v && std::isfinite(*v)))
        report((*row)[i].place(),
               fmt::format("'{}' must hold finite numbers, not {}", key,
                           v ? fmt::format("{}", *v) : std::string((*row)[i].kind())));
      if (!v || !std::isfinite(*v)) return {};
      numbers[i] = *v;
    }
  }
  return out;
}

template std::optional<std::array<double, 2>> TableReader::components(std::string_view,
                                                                      std::string_view);
template std::optional<std::array<double, 3>> TableReader::components(std::string_view,
                                                                      std::string_view);
template std::vector<std::array<double, 2>> TableReader::rows(std::string_view, std::string_view,
                                                              size_t);
template std::vector<std::array<double, 3>> TableReader::rows(std::string_view, std::string_view,
                                                              size_t);

std::vector<TableReader::Factor> TableReader::factors(std::string_view key) {
  const KeySpec& s = spec(key, "factors");
  std::vector<Factor> out;
  const Value* value = wanted(s);
  if (!value) return out;
  const Table* table = value->as_table();
  if (!table) {
    wrong_type(s, *value, "a table of name = number");
    return out;
  }
  for (const Entry& entry : table->entries()) {
    if (const auto v = checked(key, entry.value, fmt::format(" of '{}'", entry.key)))
      out.push_back({entry.key, *v, entry.value.place()});
  }
  return out;
}

// ---- words and paths ---------------------------------------------------------------------------

std::vector<std::string> TableReader::texts(std::string_view key) {
  const KeySpec& s = spec(key, "texts");
  std::vector<std::string> out;
  const List* values = list(s);
  if (!values) return out;
  for (const Value& value : *values) {
    const std::string* text = value.as_text();
    if (!text || text->empty()) {
      wrong_type(s, value, text ? "a list of texts that are not empty" : "a list of texts");
      return {};
    }
    out.push_back(*text);
  }
  return out;
}

std::vector<TableReader::Word> TableReader::words(std::string_view key) {
  const KeySpec& s = spec(key, "words");
  std::vector<Word> out;
  const Value* value = wanted(s);
  if (!value) return out;
  const Table* table = value->as_table();
  if (!table) {
    wrong_type(s, *value, "a table of name = \"text\"");
    return out;
  }
  for (const Entry& entry : table->entries()) {
    if (const std::string* text = entry.value.as_text())
      out.push_back({entry.key, *text, entry.value.place()});
    else
      wrong_type(s, entry.value, "a table of name = \"text\"");
  }
  return out;
}

std::vector<TableReader::Name> TableReader::names(std::string_view key) {
  const KeySpec& s = spec(key, "names");
  std::vector<Name> out;
  const List* values = list(s);
  if (!values) return out;
  for (const Value& value : *values) {
    if (const std::string* text = value.as_text())
      out.push_back({*text, value.place()});
    else
      wrong_type(s, value, "a list of names");
  }
  return out;
}

std::vector<TableReader::NamePair> TableReader::name_pairs(std::string_view key) {
  const KeySpec& s = spec(key, "name pairs");
  std::vector<NamePair> out;
  const List* values = list(s);
  if (!values) return out;
  for (const Value& value : *values) {
    const List* pair = value.as_list();
    const std::string* first = pair && pair->size() == 2 ? (*pair)[0].as_text() : nullptr;
    const std::string* second = first ? (*pair)[1].as_text() : nullptr;
    if (second)
      out.push_back({*first, *second, value.place()});
    else
      report(value.place(), fmt::format("'{}' must be a list of pairs of names", key));
  }
  return out;
}

std::vector<std::pair<std::filesystem::path, SourcePlace>> TableReader::files(
    std::string_view key) {
  const KeySpec& s = spec(key, "paths");
  std::vector<std::pair<std::filesystem::path, SourcePlace>> out;
  const List* values = list(s);
  if (!values) return out;
  for (const Value& value : *values) {
    const std::string* text = value.as_text();
    if (!text)
      wrong_type(s, value, "a list of paths");
    else if (auto full = existing(value, *text))
      out.emplace_back(std::move(*full), value.place());
  }
  return out;
}

// ---- tables ------------------------------------------------------------------------------------

const Table* TableReader::table(std::string_view key) {
  const KeySpec& s = spec(key, "table");
  const Value* value = wanted(s);
  if (!value) return nullptr;
  if (const Table* table = value->as_table()) return table;
  wrong_type(s, *value, "a table");
  return nullptr;
}

TableReader TableReader::inner(std::string_view key, const std::vector<std::string>& specs) {
  static const Table empty;
  const Table* said = table(key);
  return {said ? *said : empty, place(key), schema_, specs, findings_};
}

std::vector<const Table*> TableReader::tables(std::string_view key, size_t most) {
  const KeySpec& s = spec(key, "tables");
  std::vector<const Table*> out;
  const Value* value = wanted(s);
  if (!value) return out;
  const List* values = value->as_list();
  if (!values) {
    wrong_type(s, *value,
               fmt::format("a list of tables, each opened by [[{}]] or written {{ ... }}", key));
    return out;
  }
  if (values->size() > most) {
    problem(key, fmt::format("there are {} tables '{}'; at most {} are allowed", values->size(),
                             key, most));
    return out;
  }
  for (const Value& entry : *values) {
    if (const Table* table = entry.as_table()) {
      out.push_back(table);
    } else {
      wrong_type(s, entry, "a list of tables");
      return out;
    }
  }
  return out;
}

}  // namespace luxodus::toml
