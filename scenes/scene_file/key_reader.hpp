// Reads the keys of one TOML table as its TableSpec describes them: checks type, range and
// finiteness, fills in defaults, resolves paths, and reports each mistake once, with its line. A
// misspelt key is reported and then read as the key it was meant to be, so that one slip does not
// become three problems. After a mistake the methods return some value within the key's range, so
// that reading can go on and find the rest. Single-threaded; holds references to the parsed
// document and to the SceneReading.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/scene_file/scene_reading.hpp"
#include "scenes/scene_file/scene_schema.hpp"

namespace luxodus {

/// Where a value stands. `fallback` is used for what toml++ gives no line of its own.
SourcePlace place_of(const toml::node& node, const SourcePlace& fallback = {});
/// "a string", "an array": for messages.
std::string kind_of(const toml::node& node);
/// A number of a TOML integer or float; nothing for other types.
std::optional<double> number_in(const toml::node& node);

class KeyReader {
 public:
  /// Reports every key that none of the specs knows. `specs` are names of the schema.
  KeyReader(const toml::table& table, const std::vector<std::string>& specs, SceneReading& reading,
            const SourcePlace& fallback = {});

  const SourcePlace& place() const { return place_; }
  /// Of a key's value; of the table where the key is absent.
  SourcePlace place(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Nothing wrong so far with this table: checks between keys are worth while.
  bool clean() const { return clean_; }
  void problem(std::string_view key, const std::string& what);
  void problem(const std::string& what);
  SceneReading& reading() { return reading_; }

  double number(std::string_view key);
  std::optional<double> maybe_number(std::string_view key);
  int64_t integer(std::string_view key);
  std::optional<int64_t> maybe_integer(std::string_view key);
  bool flag(std::string_view key);
  std::string text(std::string_view key);
  std::optional<std::string> maybe_text(std::string_view key);
  std::string choice(std::string_view key);
  std::optional<std::string> maybe_choice(std::string_view key);
  glm::dvec2 pair(std::string_view key);
  std::optional<glm::dvec2> maybe_pair(std::string_view key);
  glm::dvec3 point(std::string_view key);
  std::optional<glm::dvec3> maybe_point(std::string_view key);
  /// A vector that is not zero, made unit length.
  glm::dvec3 direction(std::string_view key);
  std::optional<glm::dvec3> maybe_direction(std::string_view key);
  std::vector<double> numbers(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  /// Rows of two numbers; the range holds for the second.
  std::vector<glm::dvec2> pairs(std::string_view key);
  /// Rows [x, y] of points; the range holds for both.
  std::vector<glm::dvec2> corners(std::string_view key);
  /// Rows [x, y, z] of points; the range holds for all three.
  std::vector<glm::dvec3> points(std::string_view key);
  /// One number for all three axes, or three.
  glm::dvec3 scale(std::string_view key);
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
  /// A file that exists, relative to the file that names it.
  std::optional<std::filesystem::path> path(std::string_view key);
  std::vector<std::pair<std::filesystem::path, SourcePlace>> paths(std::string_view key);

  const toml::node* node(std::string_view key);
  const toml::table* table(std::string_view key);
  std::vector<const toml::table*> tables(std::string_view key);

  /// Which one of these keys is given; "" and a problem where several are, or none though `needed`.
  std::string exactly_one(std::initializer_list<std::string_view> keys, bool needed);

  /// The default that the schema gives, where it is a number or a quoted text.
  std::optional<double> default_number(std::string_view key) const;
  std::optional<std::string> default_text(std::string_view key) const;

  /// Checks a number against finiteness and the key's range.
  std::optional<double> checked(std::string_view key, const toml::node& node,
                                const char* what = "");

 private:
  const toml::node* find(std::string_view key) const;
  const KeySpec& spec(std::string_view key) const;
  const KeySpec& spec(std::string_view key, std::string_view type) const;
  const toml::node* needed(const KeySpec& spec);
  void wrong_type(const KeySpec& spec, const toml::node& node, const char* should);
  std::optional<std::vector<double>> components(const KeySpec& spec, size_t count);
  std::vector<glm::dvec2> rows(const KeySpec& spec, bool range_of_both);
  const toml::array* list(const KeySpec& spec);
  std::optional<std::filesystem::path> existing(const toml::node& node, const std::string& text);
  static double inside(const KeySpec& spec);

  const toml::table& table_;
  SceneReading& reading_;
  SourcePlace place_;
  std::map<std::string, const KeySpec*, std::less<>> specs_;
  std::map<std::string, const toml::node*, std::less<>> values_;
  bool clean_ = true;
};

/// The word of the choice `key` of a table, before a KeyReader exists: it decides which further
/// specs hold.
/// "" where it is absent without default, or none of the words; nothing is reported.
std::string table_choice(const toml::table& table, std::string_view spec, std::string_view key);

/// A reader with the keys of `base` and of `base.KIND`, where KIND is the choice `key`, reported
/// where wrong or missing; of all kinds where it is, so that their keys are not called unknown.
/// Fills in `kind`.
KeyReader kind_reader(const toml::table& table, const std::string& base, std::string_view key,
                      SceneReading& reading, std::string& kind);

/// A name: declares it for its kind. An absent name is a problem; "" is then returned.
std::string read_name(KeyReader& keys, std::string_view kind);

}  // namespace luxodus
