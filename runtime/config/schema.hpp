// Every table and key of a cluster's file, and of a study's, stated once: type, unit, default,
// range, meaning, as text. The reader takes defaults and ranges from here, README.md repeats the
// same rows, and a test compares the two, so that neither can say what the other does not do. It
// knows no values: those are in cluster_config.hpp. Constant data; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus::config {

/// One key. `type` is one of the words that README.md explains ("size", "choice", ...).
struct KeySpec {
  std::string_view name;
  std::string_view type;
  std::string_view unit;      // "" for none
  std::string_view fallback;  // TOML text; "required"; or "" where absence has a meaning
  std::string_view range;     // "[0, 1]", the words of a choice, or ""
  std::string_view meaning;
};

/// One table, or the keys that it has besides for one of its kinds ("topology.file").
struct TableSpec {
  std::string_view name;
  std::string_view heading;  // as a person writes it
  std::vector<KeySpec> keys;
};

/// All tables, in the order of the README.
const std::vector<TableSpec>& cluster_schema();
/// The tables of a study's file and of a file of costs, in the order of actors/study/README.md.
const std::vector<TableSpec>& study_schema();
/// The table of this name, of either. Requires: it exists (a programmer's mistake throws
/// std::logic_error).
const TableSpec& table_spec(std::string_view name);

/// A range of numbers.
struct Interval {
  double low;
  double high;
  bool low_open = false;

  bool holds(double v) const { return (low_open ? v > low : v >= low) && v <= high; }
};
/// Of the text "[low, high]" or "(low, high]"; nothing where it is neither.
std::optional<Interval> interval_of(std::string_view range);
/// The comma-separated words of a choice.
std::vector<std::string_view> words_of(std::string_view range);

/// A schema as a README shows it: a heading and a table of keys for each table.
std::string schema_markdown(const std::vector<TableSpec>& tables = cluster_schema());

}  // namespace luxodus::config
