// The tables and keys of a kind of file, declared once as data: type, unit, default, range and
// meaning of every key, as text. The reader takes defaults and ranges from here, a README
// repeats the same rows (schema_markdown), and a test compares the two. Constant data; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus::toml {

/// One key. `type` is one of the words that the schema's README explains ("number", "choice", ...).
struct KeySpec {
  std::string_view name;
  std::string_view type;
  std::string_view unit;      // "" for none
  std::string_view fallback;  // TOML text; "required"; or "" where absence has a meaning
  std::string_view range;     // "[0, 1]", "(0, 10]", the words of a choice, or "" for any value
  std::string_view meaning;
  std::string_view hashed_as = {};  // an earlier name, by which hashes of texts know the key
};

/// A table, or the further keys of one of its kinds ("material.glossy").
struct TableSpec {
  std::string_view name;
  std::string_view heading;  // as a person writes it
  std::vector<KeySpec> keys;
};

/// A rule that texts of a type must satisfy.
struct TextRule {
  std::string_view type;
  bool (*holds)(std::string_view text);
  std::string must_be;  // "an IPv4 address": what follows "'key' must be"
};

struct Schema {
  std::vector<TableSpec> tables;  // in the order of the README
  std::vector<TextRule> text_rules = {};

  /// Requires: the table exists (otherwise throws std::logic_error).
  const TableSpec& table(std::string_view name) const;
  /// A key of a table. Requires: it exists, likewise.
  const KeySpec& key(std::string_view table, std::string_view name) const;
  /// Null if the type has no rule.
  const TextRule* rule_of(std::string_view type) const;
};

/// A range of numbers.
struct Interval {
  double low;
  double high;
  bool low_open = false;
  bool high_open = false;

  bool holds(double v) const {
    return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
  }
};
/// Parses "[low, high]", where ( or ) exclude an end; nothing for any other text.
std::optional<Interval> interval_of(std::string_view range);
/// The comma-separated words of a choice.
std::vector<std::string_view> words_of(std::string_view range);

/// A schema as a README shows it: a heading and a table of keys for each table.
std::string schema_markdown(const Schema& schema);

}  // namespace luxodus::toml
