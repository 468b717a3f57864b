// The keys of a table, and those whose value is one number, word or path. Lists and inner tables
// are in table_reader_lists.cpp.
#include "runtime/toml/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include "runtime/core/printable.hpp"
#include "runtime/toml/words.hpp"

namespace luxodus::toml {

namespace {

/// A share of this value or more, up to 100, is probably a percentage.
constexpr double min_percent = 5;

/// Shortest readable text: 0.5, 2, 1e+07.
std::string shown(double v) {
  return fmt::format("{:.10g}", v);
}

/// If a number of degrees equals a common angle in radians to three digits or more, that angle
/// [deg]. Numbers with fewer digits are too close to intended angles.
std::optional<double> degrees_of_radians(double v) {
  constexpr double pi = std::numbers::pi, rounding = 2e-3;
  for (const double degrees : {30, 45, 60, 90, 120, 135, 180, 270, 360})
    if (std::abs(std::abs(v) - degrees * pi / 180) < rounding) return v < 0 ? -degrees : degrees;
  return std::nullopt;
}

std::string list_words(std::string_view range) {
  std::string out;
  for (const auto word : words_of(range))
    out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", word);
  return out;
}

/// The text between the quotes of a default.
std::optional<std::string_view> unquoted(std::string_view fallback) {
  if (fallback.size() < 2 || fallback.front() != '"') return std::nullopt;
  return fallback.substr(1, fallback.size() - 2);
}

}  // namespace

// ---- keys --------------------------------------------------------------------------------------

TableReader::TableReader(const Table& table, const Schema& schema,
                         const std::vector<std::string>& specs, Findings& findings)
    : TableReader(table, table.place(), schema, specs, findings) {}

TableReader::TableReader(const Table& table, SourcePlace place, const Schema& schema,
                         const std::vector<std::string>& specs, Findings& findings)
    : schema_(schema), findings_(findings), place_(std::move(place)) {
  for (const std::string& name : specs) {
    for (const KeySpec& key : schema.table(name).keys) specs_.push_back(&key);
  }
  for (const Entry& entry : table.entries()) {
    if (const KeySpec* key = known(entry.key)) values_.emplace(key->name, &entry.value);
  }
  for (const Entry& entry : table.entries()) {
    if (!known(entry.key)) take_unknown(entry);
  }
}

/// An entry whose key is not in the schema: a misspelt one is read as the key that was meant.
void TableReader::take_unknown(const Entry& entry) {
  const SourcePlace at{entry.value.place().file, entry.line};
  std::vector<std::string_view> names;
  for (const KeySpec* key : specs_) names.push_back(key->name);
  std::string what = fmt::format("unknown key '{}'", excerpt(entry.key));
  if (const auto near = nearest_word(entry.key, names)) {
    what += fmt::format("; did you mean '{}'?", *near);
    values_.emplace(*near, &entry.value);  // no effect if the correct key is there, too
  } else {
    what += "; known here:";
    for (const KeySpec* key : specs_) what += fmt::format(" {}", key->name);
  }
  report(at, std::move(what));
}

SourcePlace TableReader::place(std::string_view key) const {
  const Value* value = find(key);
  return value ? value->place() : place_;
}

void TableReader::report(SourcePlace where, std::string what) {
  clean_ = false;
  findings_.problem(std::move(where), std::move(what));
}

const Value* TableReader::find(std::string_view key) const {
  const auto at = values_.find(key);
  return at == values_.end() ? nullptr : at->second;
}

const KeySpec* TableReader::known(std::string_view key) const {
  const auto at = std::find_if(specs_.begin(), specs_.end(),
                               [&](const KeySpec* spec) { return spec->name == key; });
  return at == specs_.end() ? nullptr : *at;
}

const KeySpec& TableReader::spec(std::string_view key) const {
  if (const KeySpec* s = known(key)) return *s;
  throw std::logic_error(fmt::format("no key '{}' in the schema", key));
}

const KeySpec& TableReader::spec(std::string_view key, std::string_view type) const {
  const KeySpec& s = spec(key);
  if (s.type != type)
    throw std::logic_error(
        fmt::format("key '{}' is a {} in the schema, read as a {}", key, s.type, type));
  return s;
}

const Value* TableReader::wanted(const KeySpec& s) {
  const Value* value = find(s.name);
  if (!value && s.fallback == "required")
    problem(fmt::format("the key '{}' is missing: {}", s.name, s.meaning));
  return value;
}

void TableReader::wrong_type(const KeySpec& s, const Value& value, std::string_view should) {
  report(value.place(), fmt::format("'{}' must be {}, not {}", s.name, should, value.kind()));
}

std::string TableReader::exactly_one(std::initializer_list<std::string_view> keys, bool needed) {
  std::string given, all;
  int count = 0;
  for (const auto key : keys) {
    all += fmt::format("{}'{}'", all.empty() ? "" : ", ", key);
    if (!has(key)) continue;
    if (++count == 2)
      problem(key, fmt::format("'{}' and '{}' say the same thing; keep one of them", key, given));
    if (count == 1) given = key;
  }
  if (count == 0 && needed) problem(fmt::format("one of the keys {} is needed", all));
  return count == 1 ? given : std::string();
}

// ---- defaults ----------------------------------------------------------------------------------

std::optional<double> TableReader::default_number(std::string_view key) const {
  const std::string literal(spec(key).fallback);
  char* end = nullptr;
  const double v = std::strtod(literal.c_str(), &end);
  return end != literal.c_str() && *end == '\0' ? std::optional(v) : std::nullopt;
}

std::optional<std::string> TableReader::default_text(std::string_view key) const {
  const auto text = unquoted(spec(key).fallback);
  return text ? std::optional<std::string>(*text) : std::nullopt;
}

double TableReader::some_number(std::string_view key) const {
  if (const auto number = default_number(key)) return *number;
  const auto range = interval_of(spec(key).range);
  return !range || range->holds(1) ? 1 : 0.5 * (range->low + range->high);
}

// ---- numbers -----------------------------------------------------------------------------------

std::optional<double> TableReader::bounded(const KeySpec& s, const SourcePlace& where, double v,
                                           std::string_view what) {
  if (!std::isfinite(v)) {
    report(where, fmt::format("'{}'{} must be a finite number, not {}", s.name, what, shown(v)));
    return std::nullopt;
  }
  const auto range = interval_of(s.range);
  if (!range || range->holds(v)) {
    if (const auto meant = degrees_of_radians(v); meant && s.unit == "deg")
      findings_.warning(where, fmt::format("'{}'{} is {} deg, and {} rad are {} deg: angles are in "
                                           "degrees",
                                           s.name, what, shown(v), shown(v), shown(*meant)));
    return v;
  }
  std::string wrong =
      fmt::format("'{}'{} is {} but must lie in {}", s.name, what, shown(v), s.range);
  if (!s.unit.empty()) wrong += fmt::format(" {}", s.unit);
  if (s.unit == "m" && v > range->high)
    wrong += fmt::format("; metres? {} mm is {}", shown(v), shown(v / 1000));
  if (s.unit.empty() && range->high == 1 && v >= min_percent && v <= 100)
    wrong += fmt::format("; a share? {} % is {}", shown(v), shown(v / 100));
  report(where, std::move(wrong));
  return std::nullopt;
}

std::optional<double> TableReader::checked(std::string_view key, const Value& value,
                                           std::string_view what) {
  const KeySpec& s = spec(key);
  const auto v = value.as_number();
  if (!v) {
    report(value.place(), fmt::format("'{}'{} must be a number, not {}", key, what, value.kind()));
    return std::nullopt;
  }
  return bounded(s, value.place(), *v, what);
}

std::optional<double> TableReader::maybe_number(std::string_view key) {
  const Value* value = wanted(spec(key, "number"));
  return value ? checked(key, *value) : default_number(key);
}

double TableReader::number(std::string_view key) {
  return maybe_number(key).value_or(some_number(key));
}

std::optional<int64_t> TableReader::maybe_integer(std::string_view key) {
  const KeySpec& s = spec(key, "integer");
  const Value* value = wanted(s);
  if (!value) {
    const auto fallback = default_number(key);
    return fallback ? std::optional(static_cast<int64_t>(*fallback)) : std::nullopt;
  }
  const int64_t* whole = value->as_integer();
  if (!whole) wrong_type(s, *value, "a whole number");
  if (!whole || !checked(key, *value)) return std::nullopt;
  return *whole;
}

int64_t TableReader::integer(std::string_view key) {
  return maybe_integer(key).value_or(static_cast<int64_t>(some_number(key)));
}

uint64_t TableReader::size(std::string_view key) {
  const KeySpec& s = spec(key, "size");
  const double usual =
      bytes_in(unquoted(s.fallback).value_or(s.fallback)).value_or(some_number(key));
  const Value* value = wanted(s);
  if (!value) return static_cast<uint64_t>(usual);
  std::optional<double> bytes;
  if (const int64_t* whole = value->as_integer()) bytes = static_cast<double>(*whole);
  if (const std::string* written = value->as_text()) bytes = bytes_in(*written);
  if (!bytes) {
    report(value->place(),
           fmt::format("'{}' must be a number of bytes, or a text such as \"512 MiB\" (KiB, MiB, "
                       "GiB, TiB, KB, MB, GB, TB)",
                       key));
    return static_cast<uint64_t>(usual);
  }
  return static_cast<uint64_t>(bounded(s, value->place(), *bytes).value_or(usual));
}

// ---- words and paths ---------------------------------------------------------------------------

bool TableReader::flag(std::string_view key) {
  const KeySpec& s = spec(key, "flag");
  const bool fallback = s.fallback == "true";
  const Value* value = wanted(s);
  if (!value) return fallback;
  if (const bool* said = value->as_flag()) return *said;
  wrong_type(s, *value, "true or false");
  return fallback;
}

std::optional<std::string> TableReader::maybe_text(std::string_view key) {
  const KeySpec& s = spec(key);
  const TextRule* rule = schema_.rule_of(s.type);
  if (!rule) spec(key, "text");
  const Value* value = wanted(s);
  if (!value) return default_text(key);
  const std::string* text = value->as_text();
  if (!text) {
    wrong_type(s, *value, "a text");
    return std::nullopt;
  }
  if (rule && !rule->holds(*text)) {
    problem(key, fmt::format("'{}' must be {}", key, rule->must_be));
    return std::nullopt;
  }
  if (text->size() <= limits::toml_values) return *text;
  problem(key, fmt::format("'{}' is longer than {} characters", key, limits::toml_values));
  return std::nullopt;
}

std::string TableReader::text(std::string_view key) {
  return maybe_text(key).value_or("");
}

std::optional<std::string> TableReader::chosen(std::string_view key, const Value& value) {
  const KeySpec& s = spec(key);
  const auto words = words_of(s.range);
  const auto knows = [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (const bool* flag = value.as_flag()) {
    // A choice with the words true and false accepts them without quotes.
    const std::string word = *flag ? "true" : "false";
    if (knows(word)) return word;
  }
  const std::string* text = value.as_text();
  if (!text) {
    wrong_type(s, value, "one of " + list_words(s.range));
    return std::nullopt;
  }
  if (knows(*text)) return *text;
  std::string what =
      fmt::format("'{}' is \"{}\" but must be one of {}", key, excerpt(*text), list_words(s.range));
  if (const auto near = nearest_word(*text, words))
    what += fmt::format("; did you mean \"{}\"?", *near);
  report(value.place(), std::move(what));
  return std::nullopt;
}

std::optional<std::string> TableReader::maybe_choice(std::string_view key) {
  const Value* value = wanted(spec(key, "choice"));
  return value ? chosen(key, *value) : default_text(key);
}

std::string TableReader::choice(std::string_view key) {
  if (auto word = maybe_choice(key)) return std::move(*word);
  return default_text(key).value_or(std::string(words_of(spec(key).range).front()));
}

namespace {

std::filesystem::path beside(const SourcePlace& place, const std::string& text) {
  return (std::filesystem::path(place.file).parent_path() / text).lexically_normal();
}

}  // namespace

std::filesystem::path TableReader::path(std::string_view key) {
  const KeySpec& s = spec(key, "path");
  const Value* value = wanted(s);
  if (!value) return {};
  const std::string* text = value->as_text();
  if (!text)
    wrong_type(s, *value, "the path of a file or folder");
  else if (text->empty() || text->size() > limits::toml_values ||
           text->find('\0') != std::string::npos)
    problem(key, fmt::format("'{}' must name a file or folder", key));
  else
    return beside(value->place(), *text);
  return {};
}

std::optional<std::filesystem::path> TableReader::existing(const Value& value,
                                                           const std::string& text) {
  namespace fs = std::filesystem;
  const fs::path full = beside(value.place(), text);
  std::error_code error;
  const auto status = fs::status(full, error);
  std::string what;
  if (text.empty() || text.find('\0') != std::string::npos)
    what = "an empty text names no file";
  else if (status.type() == fs::file_type::none)
    what =
        fmt::format("the file '{}' cannot be read: {} ({})", text, error.message(), full.string());
  else if (!fs::exists(status))
    what = fmt::format("there is no file '{}' (looked for {})", text, full.string());
  else if (!fs::is_regular_file(status))
    what = fmt::format("'{}' is not a file ({})", text, full.string());
  else
    return full;
  report(value.place(), std::move(what));
  return std::nullopt;
}

std::optional<std::filesystem::path> TableReader::file(std::string_view key) {
  const KeySpec& s = spec(key, "path");
  const Value* value = wanted(s);
  if (!value) return std::nullopt;
  if (const std::string* text = value->as_text()) return existing(*value, *text);
  wrong_type(s, *value, "the path of a file");
  return std::nullopt;
}

// ---- kinds -------------------------------------------------------------------------------------

std::string chosen_kind(const Table& table, const Schema& schema, std::string_view spec,
                        std::string_view key) {
  const KeySpec& s = schema.key(spec, key);
  const Value* value = table.find(key);
  if (!value) return std::string(unquoted(s.fallback).value_or(""));
  const std::string* text = value->as_text();
  const auto words = words_of(s.range);
  return text && std::find(words.begin(), words.end(), *text) != words.end() ? *text
                                                                             : std::string();
}

std::vector<std::string> specs_of_kind(const Schema& schema, const std::string& base,
                                       std::string_view key, std::string_view kind) {
  std::vector<std::string> specs{base};
  for (const auto word : words_of(schema.key(base, key).range)) {
    if (kind.empty() || kind == word) specs.push_back(base + "." + std::string(word));
  }
  return specs;
}

}  // namespace luxodus::toml
