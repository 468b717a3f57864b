// Values of a TOML document with their places: tables, lists, texts, numbers, flags, dates. No
// value refers to the parser, so only document.cpp includes it; every value refers to its Document,
// which must outlive it. Immutable; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus::toml {

class Value;
struct Entry;
using List = std::vector<Value>;

/// Where a value was read: the file's name, owned by the Document, and a line.
struct Origin {
  const std::string* file = nullptr;
  int line = 0;

  SourcePlace place() const { return {file ? *file : std::string(), line}; }
};

/// Keys with their values.
class Table {
 public:
  Table() = default;
  /// Requires: entries are sorted by key, and keys are unique.
  Table(Origin origin, std::vector<Entry> entries);

  SourcePlace place() const { return origin_.place(); }
  /// Null if the key is absent.
  const Value* find(std::string_view key) const;
  /// Sorted by key.
  const std::vector<Entry>& entries() const { return entries_; }
  /// This table, with the entries of `base` for keys it lacks; each keeps its place.
  Table over(const Table& base) const;

 private:
  Origin origin_;
  std::vector<Entry> entries_;
};

/// A date, a time, or both, as TOML writes it.
struct Moment {
  std::string text;
  bool is_date = false;  // without a time
};

class Value {
 public:
  using Data = std::variant<Table, List, std::string, int64_t, double, bool, Moment>;

  Value(Origin origin, Data data) : origin_(origin), data_(std::move(data)) {}

  SourcePlace place() const { return origin_.place(); }
  /// For messages: "a text", "an array".
  std::string_view kind() const;

  /// Null if it is of another kind.
  const Table* as_table() const { return std::get_if<Table>(&data_); }
  const List* as_list() const { return std::get_if<List>(&data_); }
  const std::string* as_text() const { return std::get_if<std::string>(&data_); }
  const int64_t* as_integer() const { return std::get_if<int64_t>(&data_); }
  const bool* as_flag() const { return std::get_if<bool>(&data_); }
  const Moment* as_moment() const { return std::get_if<Moment>(&data_); }
  /// Also for integers.
  std::optional<double> as_number() const;

 private:
  Origin origin_;
  Data data_;
};

struct Entry {
  std::string key;
  int line = 0;  // of the key
  Value value;
};

}  // namespace luxodus::toml
