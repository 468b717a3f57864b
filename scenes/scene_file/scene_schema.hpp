// Every table and key of a scene file, stated once: type, unit, default, range, meaning, as text.
// The reader takes defaults and ranges from here, README.md repeats the same rows, and a test
// compares the two, so that neither can say what the other does not do. Constant data; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

/// One key. `type` is one of the words explained in README.md ("number", "point", "choice", ...).
struct KeySpec {
  std::string_view name;
  std::string_view type;
  std::string_view unit;  // "" for none
  std::string_view
      fallback;  // TOML text of the default; "required"; or "" where absence has a meaning
  std::string_view range;  // "[0, 1]", "(0, 10]", the words of a choice, or "" for any finite value
  std::string_view meaning;
};

/// One table, or the keys that a table has besides for one of its kinds ("material.glossy").
struct TableSpec {
  std::string_view name;
  std::string_view heading;  // as written in a scene file
  std::vector<KeySpec> keys;
};

/// All tables, in the order of the README.
const std::vector<TableSpec>& scene_schema();
/// The table of this name. Requires: it exists (a programmer's mistake throws std::logic_error).
const TableSpec& table_spec(std::string_view name);

/// A range as numbers. Low and high may be infinite.
struct Interval {
  double low;
  double high;
  bool low_open = false;
  bool high_open = false;

  bool holds(double v) const {
    return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
  }
};
/// Of the text of a range; nothing where it is not an interval.
std::optional<Interval> interval_of(std::string_view range);
/// The comma-separated words of a choice.
std::vector<std::string_view> words_of(std::string_view range);

/// The schema as the README shows it: a heading and a table of keys for each table.
std::string schema_markdown();

/// The key `repeat`, wherever things are placed.
KeySpec repeat_key();

// Pieces of the schema, one per source file.
std::vector<TableSpec> geometry_schema();
std::vector<TableSpec> object_schema();    // part of geometry_schema
std::vector<TableSpec> data_set_schema();  // part of light_schema
std::vector<TableSpec> light_schema();
std::vector<TableSpec> measure_schema();
std::vector<TableSpec> assessment_schema();
std::vector<TableSpec> project_schema();

}  // namespace luxodus
