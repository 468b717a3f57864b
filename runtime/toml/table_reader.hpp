// Reads the keys of one table by its specs: checks type, range and finiteness, fills in defaults,
// and reports each mistake once, with its line. A misspelt key is reported and then read as the key
// that was meant, so that one slip does not become three problems. After a mistake the methods
// return some valid value, so that reading goes on and finds the rest. It opens no file. Holds
// references to the document, the schema and the findings. Single-threaded.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/toml/findings.hpp"
#include "runtime/toml/schema.hpp"
#include "runtime/toml/value.hpp"

namespace luxodus {

namespace limits {
/// Values in one list, and characters in one text.
inline constexpr size_t toml_values = 100'000;
/// Tables in one list of tables.
inline constexpr size_t toml_tables = 100'000;
}  // namespace limits

namespace toml {

class TableReader {
 public:
  /// Reports every key that is in none of the specs. `specs` are names of the schema's tables.
  TableReader(const Table& table, const Schema& schema, const std::vector<std::string>& specs,
              Findings& findings);
  /// A reader of the table under this key; of an empty table, with all defaults, if the key is
  /// absent.
  TableReader inner(std::string_view key, const std::vector<std::string>& specs);

  const SourcePlace& place() const { return place_; }
  /// Place of a key's value, or of the table if the key is absent.
  SourcePlace place(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Whether nothing is wrong with this table so far, so that checks across keys make sense.
  bool clean() const { return clean_; }
  void problem(std::string_view key, std::string what) { report(place(key), std::move(what)); }
  void problem(std::string what) { report(place_, std::move(what)); }

  double number(std::string_view key);
  std::optional<double> maybe_number(std::string_view key);
  int64_t integer(std::string_view key);
  std::optional<int64_t> maybe_integer(std::string_view key);
  /// Bytes: a number, or a text such as "512 MiB".
  uint64_t size(std::string_view key);
  bool flag(std::string_view key);
  /// For the type "text" and types with a text rule; "" if absent.
  std::string text(std::string_view key);
  std::optional<std::string> maybe_text(std::string_view key);
  std::string choice(std::string_view key);
  std::optional<std::string> maybe_choice(std::string_view key);
  /// Relative to the file's folder; empty if absent. Existence is not checked.
  std::filesystem::path path(std::string_view key);
  /// Likewise, but the file must exist.
  std::optional<std::filesystem::path> file(std::string_view key);
  std::vector<std::pair<std::filesystem::path, SourcePlace>> files(std::string_view key);

  std::vector<double> numbers(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  /// Exactly N numbers of a key of this type.
  template <size_t N>
  std::optional<std::array<double, N>> components(std::string_view key, std::string_view type);
  /// Rows of N numbers of a key of this type; the range applies from column `first_bounded` on.
  template <size_t N>
  std::vector<std::array<double, N>> rows(std::string_view key, std::string_view type,
                                          size_t first_bounded);
  /// A table of name = number.
  struct Factor {
    std::string name;
    double value;
    SourcePlace place;
  };
  std::vector<Factor> factors(std::string_view key);
  /// A table of name = text.
  struct Word {
    std::string name;
    std::string text;
    SourcePlace place;
  };
  std::vector<Word> words(std::string_view key);
  /// A list of names, each with its place.
  struct Name {
    std::string text;
    SourcePlace place;
  };
  std::vector<Name> names(std::string_view key);
  /// A list of pairs of names.
  struct NamePair {
    std::string first, second;
    SourcePlace place;
  };
  std::vector<NamePair> name_pairs(std::string_view key);

  /// Null if the key is absent or wrong.
  const Table* table(std::string_view key);
  std::vector<const Table*> tables(std::string_view key, size_t most = limits::toml_tables);

  /// Which of these keys is given; "" and a problem if several are, or if none is although
  /// `needed`.
  std::string exactly_one(std::initializer_list<std::string_view> keys, bool needed);

  // For keys whose values have forms of their own.

  /// The value unchecked; null if the key is absent.
  const Value* value(std::string_view key) { return wanted(spec(key)); }
  /// A number of this key if it is one, finite and within the range. `what` names it in messages.
  std::optional<double> checked(std::string_view key, const Value& value,
                                std::string_view what = "");
  /// A word of this key if it is one of its choices.
  std::optional<std::string> chosen(std::string_view key, const Value& value);
  /// The schema's default, if it is a number or a quoted text.
  std::optional<double> default_number(std::string_view key) const;
  std::optional<std::string> default_text(std::string_view key) const;
  /// A valid number for the key: its default, or one within its range.
  double some_number(std::string_view key) const;

 private:
  TableReader(const Table& table, SourcePlace place, const Schema& schema,
              const std::vector<std::string>& specs, Findings& findings);
  void take_unknown(const Entry& entry);
  void report(SourcePlace where, std::string what);
  const Value* find(std::string_view key) const;
  const KeySpec* known(std::string_view key) const;
  const KeySpec& spec(std::string_view key) const;
  const KeySpec& spec(std::string_view key, std::string_view type) const;
  const Value* wanted(const KeySpec& spec);
  void wrong_type(const KeySpec& spec, const Value& value, std::string_view should);
  std::optional<double> bounded(const KeySpec& spec, const SourcePlace& where, double value,
                                std::string_view what = "");
  const List* list(const KeySpec& spec);
  std::optional<std::filesystem::path> existing(const Value& value, const std::string& text);

  const Schema& schema_;
  Findings& findings_;
  SourcePlace place_;
  std::vector<const KeySpec*> specs_;                // in the schema's order
  std::map<std::string_view, const Value*> values_;  // by current name
  bool clean_ = true;
};

/// The word of the choice `key` of a table, before a reader exists: it decides which further specs
/// apply. "" if it is absent without default, or no valid word; nothing is reported.
std::string chosen_kind(const Table& table, const Schema& schema, std::string_view spec,
                        std::string_view key);

/// `base`, and `base.KIND` for this word of the choice `key`; for "" all kinds, so that their keys
/// are not reported as unknown.
std::vector<std::string> specs_of_kind(const Schema& schema, const std::string& base,
                                       std::string_view key, std::string_view kind);

}  // namespace toml
}  // namespace luxodus
