// Reads the keys of one TOML table as its TableSpec describes them: checks type and range, fills in
// defaults, and reports each mistake once, with its line. A misspelt key is reported and then read
// as the key it was meant to be, so that one slip does not become three problems. After a mistake
// the methods return some value within the range, so that reading goes on and finds the rest.
// Holds references to the document and the problems. Single-threaded.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/config/schema.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::config {

/// Problems found so far. What a document can make us say is bounded.
class Findings {
 public:
  /// Sentences kept: after these a file is broken as a whole.
  static constexpr size_t most = 200;

  void add(const SourcePlace& where, std::string what);
  bool empty() const { return list_.empty(); }
  /// By line.
  Problems take();

 private:
  std::vector<Problem> list_;
};

class TableReader {
 public:
  /// Reports every key that none of the specs knows. `specs` are names of the schema.
  /// `where` is used for what toml++ gives no line of its own.
  TableReader(const toml::table& table, const std::vector<std::string_view>& specs,
              Findings& findings, const SourcePlace& where);

  const SourcePlace& place() const { return place_; }
  /// Of a key's value; of the table where the key is absent.
  SourcePlace place(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  void problem(std::string_view key, std::string what) { findings_.add(place(key), what); }

  /// `fallback`, where given, stands in for the default of the schema.
  uint64_t integer(std::string_view key, std::optional<uint64_t> fallback = {});
  std::optional<uint64_t> maybe_integer(std::string_view key);
  double number(std::string_view key);
  std::optional<double> maybe_number(std::string_view key);
  /// Bytes: a number, or a text such as "512 MiB".
  uint64_t size(std::string_view key, std::optional<uint64_t> fallback = {});
  bool flag(std::string_view key);
  std::string choice(std::string_view key);
  /// "" where the key is absent without a default, or wrong.
  std::string text(std::string_view key);
  std::string name(std::string_view key);
  std::string address(std::string_view key);
  /// Relative to the folder of the file; empty as text() is. It need not exist.
  std::filesystem::path path(std::string_view key);

  /// Rows of two texts.
  struct Pair {
    std::string first, second;
    SourcePlace place;
  };
  std::vector<Pair> pairs(std::string_view key, size_t most);

  /// One number, or a list of them, in which none stands twice; the default of the schema where the
  /// key is absent. Of the schema's types "numbers" and "integers".
  std::vector<double> numbers(std::string_view key, size_t most);
  /// The same of words of the key's range: type "choices".
  std::vector<std::string> choices(std::string_view key, size_t most);

  /// A list of names of nodes; empty where the key is absent.
  struct Name {
    std::string text;
    SourcePlace place;
  };
  std::vector<Name> names(std::string_view key, size_t most);

  /// An empty table where the key is absent.
  const toml::table& table(std::string_view key);
  std::vector<const toml::table*> tables(std::string_view key, size_t most);

 private:
  const toml::node* find(std::string_view key) const;
  const KeySpec& spec(std::string_view key, std::string_view type) const;
  const toml::node* wanted(const KeySpec& spec);
  void wrong_type(const KeySpec& spec, const toml::node& node, std::string_view should);
  std::optional<double> checked(const KeySpec& spec, const toml::node& node, double value);
  std::optional<uint64_t> size_in(const KeySpec& spec, const toml::node& node);
  std::string text_of(const KeySpec& spec);
  std::vector<const toml::node*> listed(const KeySpec& spec, const toml::node& node, size_t most);
  bool fits(const KeySpec& spec, const toml::node& node, const std::string& word);

  SourcePlace place_;
  Findings& findings_;
  std::map<std::string_view, const KeySpec*> specs_;
  std::map<std::string_view, const toml::node*> values_;
};

/// Where a value stands, in a file already known.
SourcePlace place_of(const toml::node& node, const SourcePlace& fallback);

/// The nearest of these words, or nothing where none is near enough to be what was meant.
std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known);

/// "4096", "512 MiB", "1.5 GB" -> bytes; nothing for other texts.
std::optional<double> bytes_of(std::string_view text);

}  // namespace luxodus::config
