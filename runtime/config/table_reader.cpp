#include "runtime/config/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "runtime/config/cluster_config.hpp"
#include "runtime/core/printable.hpp"

namespace luxodus::config {

namespace {

/// Longer texts are no paths, names or scenarios; PATH_MAX of Linux.
constexpr size_t text_chars_most = 4096;
/// Characters of a wrong value that are repeated in what is said of it.
constexpr size_t shown_most = 60;

std::string_view kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string_view unquoted(std::string_view fallback) {
  const bool quoted = fallback.size() >= 2 && fallback.front() == '"';
  return quoted ? fallback.substr(1, fallback.size() - 2) : fallback;
}

/// Within the range of a number that is wrong or missing.
double inside(const KeySpec& spec) {
  const auto fallback = bytes_of(unquoted(spec.fallback));
  if (fallback) return *fallback;
  const auto range = interval_of(spec.range);
  return range ? std::max(range->low, std::min(1.0, range->high)) : 1;
}

/// Steps (insert, remove, replace, swap neighbours) from one word to another.
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> before, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string_view> nearest_word(std::string_view word,
                                             const std::vector<std::string_view>& known) {
  std::optional<std::string_view> nearest;
  if (word.size() > shown_most) return nearest;  // longer than any key
  size_t too_far = word.size() / 3 + 1;          // a third of the word may be wrong
  for (const auto candidate : known) {
    const size_t steps = distance(word, candidate);
    if (steps >= std::min(too_far, candidate.size())) continue;
    too_far = steps;
    nearest = candidate;
  }
  return nearest;
}

std::optional<double> bytes_of(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 9> units{{{"", 1},
                                                                      {"KiB", 0x1p10},
                                                                      {"MiB", 0x1p20},
                                                                      {"GiB", 0x1p30},
                                                                      {"TiB", 0x1p40},
                                                                      {"KB", 1e3},
                                                                      {"MB", 1e6},
                                                                      {"GB", 1e9},
                                                                      {"TB", 1e12}}};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  if (text.size() > 1 && text.front() == ' ') text.remove_prefix(1);
  for (const auto& [unit, factor] : units) {
    if (text == unit) return value * factor;
  }
  return std::nullopt;
}

SourcePlace place_of(const toml::node& node, const SourcePlace& fallback) {
  const int line = static_cast<int>(node.source().begin.line);
  return {fallback.file, line > 0 ? line : fallback.line};
}

void Findings::add(const SourcePlace& where, std::string what) {
  if (list_.size() < most) list_.push_back({where, std::move(what)});
}

Problems Findings::take() {
  std::stable_sort(list_.begin(), list_.end(),
                   [](const Problem& a, const Problem& b) { return a.where.line < b.where.line; });
  Problems all;
  for (Problem& problem : list_) all.add(std::move(problem));
  list_.clear();
  return all;
}

TableReader::TableReader(const toml::table& table, const std::vector<std::string_view>& specs,
                         Findings& findings, const SourcePlace& where)
    : place_(place_of(table, where)), findings_(findings) {
  std::vector<std::string_view> known;
  for (const auto name : specs) {
    for (const KeySpec& key : table_spec(name).keys) {
      specs_.emplace(key.name, &key);
      known.push_back(key.name);
    }
  }
  for (auto&& [key, value] : table) {
    if (const auto it = specs_.find(std::string_view(key)); it != specs_.end())
      values_.emplace(it->first, &value);
  }
  for (auto&& [key, value] : table) {
    const std::string_view name = key;
    if (specs_.count(name) > 0) continue;
    std::string what = fmt::format("there is no key '{}' here", excerpt(name));
    if (const auto near = nearest_word(name, known)) {
      what += fmt::format("; did you mean '{}'?", *near);
      values_.emplace(*near, &value);  // no effect where the right key stands too
    } else {
      what += "; known are:";
      for (const auto k : known) what += fmt::format(" {}", k);
    }
    const int line = static_cast<int>(key.source().begin.line);
    findings_.add({place_.file, line > 0 ? line : place_.line}, std::move(what));
  }
}

const toml::node* TableReader::find(std::string_view key) const {
  const auto it = values_.find(key);
  return it == values_.end() ? nullptr : it->second;
}

SourcePlace TableReader::place(std::string_view key) const {
  const toml::node* node = find(key);
  return node ? place_of(*node, place_) : place_;
}

const KeySpec& TableReader::spec(std::string_view key, std::string_view type) const {
  const auto it = specs_.find(key);
  if (it == specs_.end() || it->second->type != type)
    throw std::logic_error(fmt::format("the schema has no {} '{}' here", type, key));
  return *it->second;
}

const toml::node* TableReader::wanted(const KeySpec& s) {
  const toml::node* node = find(s.name);
  if (!node && s.fallback == "required")
    problem(s.name, fmt::format("the key '{}' is missing: {}", s.name, s.meaning));
  return node;
}

void TableReader::wrong_type(const KeySpec& s, const toml::node& node, std::string_view should) {
  findings_.add(place_of(node, place_),
                fmt::format("'{}' must be {}, not {}", s.name, should, kind_of(node)));
}

std::optional<double> TableReader::checked(const KeySpec& s, const toml::node& node, double value) {
  const auto range = interval_of(s.range);
  if (std::isfinite(value) && (!range || range->holds(value))) return value;
  findings_.add(place_of(node, place_),
                fmt::format("'{}' is {} but must lie in {}{}{}", s.name, value, s.range,
                            s.unit.empty() ? "" : " ", s.unit));
  return std::nullopt;
}

std::optional<uint64_t> TableReader::maybe_integer(std::string_view key) {
  const KeySpec& s = spec(key, "integer");
  const toml::node* node = wanted(s);
  if (!node) {
    if (const auto fallback = bytes_of(s.fallback)) return static_cast<uint64_t>(*fallback);
    return std::nullopt;
  }
  const auto* value = node->as_integer();
  if (!value) {
    wrong_type(s, *node, "a whole number");
    return std::nullopt;
  }
  if (!checked(s, *node, static_cast<double>(value->get()))) return std::nullopt;
  return static_cast<uint64_t>(value->get());  // no range goes below 0
}

uint64_t TableReader::integer(std::string_view key, std::optional<uint64_t> fallback) {
  if (fallback && !has(key)) return *fallback;
  return maybe_integer(key).value_or(static_cast<uint64_t>(inside(spec(key, "integer"))));
}

std::optional<double> TableReader::maybe_number(std::string_view key) {
  const KeySpec& s = spec(key, "number");
  const toml::node* node = wanted(s);
  if (!node) return bytes_of(s.fallback);
  if (const auto* whole = node->as_integer())
    return checked(s, *node, static_cast<double>(whole->get()));
  if (const auto* value = node->as_floating_point()) return checked(s, *node, value->get());
  wrong_type(s, *node, "a number");
  return std::nullopt;
}

double TableReader::number(std::string_view key) {
  return maybe_number(key).value_or(inside(spec(key, "number")));
}

std::optional<uint64_t> TableReader::size_in(const KeySpec& s, const toml::node& node) {
  std::optional<double> bytes;
  if (const auto* whole = node.as_integer()) bytes = static_cast<double>(whole->get());
  if (const auto* written = node.as_string()) bytes = bytes_of(written->get());
  if (!bytes) {
    findings_.add(place_of(node, place_),
                  fmt::format("'{}' must be a number of bytes, or a text such as \"512 MiB\" (KiB, "
                              "MiB, GiB, TiB, KB, MB, GB, TB)",
                              s.name));
    return std::nullopt;
  }
  if (!checked(s, node, *bytes)) return std::nullopt;
  return static_cast<uint64_t>(*bytes);
}

uint64_t TableReader::size(std::string_view key, std::optional<uint64_t> fallback) {
  const KeySpec& s = spec(key, "size");
  const uint64_t usual = fallback.value_or(static_cast<uint64_t>(inside(s)));
  const toml::node* node = wanted(s);
  return node ? size_in(s, *node).value_or(usual) : usual;
}

bool TableReader::flag(std::string_view key) {
  const KeySpec& s = spec(key, "flag");
  const bool fallback = s.fallback == "true";
  const toml::node* node = wanted(s);
  if (!node) return fallback;
  if (const auto* value = node->as_boolean()) return value->get();
  wrong_type(s, *node, "true or false");
  return fallback;
}

std::string TableReader::text_of(const KeySpec& s) {
  const toml::node* node = wanted(s);
  if (!node) return s.fallback == "required" ? "" : std::string(unquoted(s.fallback));
  const auto* value = node->as_string();
  if (!value) {
    wrong_type(s, *node, "a text");
    return "";
  }
  const std::string& text = value->get();
  const bool control = std::any_of(text.begin(), text.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (!control && text.size() <= text_chars_most) return text;
  problem(s.name, fmt::format("'{}' must have no control characters and at most {} characters",
                              s.name, text_chars_most));
  return "";
}

std::string TableReader::text(std::string_view key) {
  return text_of(spec(key, "text"));
}

std::string TableReader::name(std::string_view key) {
  std::string text = text_of(spec(key, "name"));
  if (!has(key)) return text;
  const std::string fault = name_fault(text);
  if (fault.empty()) return text;
  problem(key, fmt::format("'{}' is no name: {}", key, fault));
  return "";
}

std::string TableReader::address(std::string_view key) {
  std::string text = text_of(spec(key, "address"));
  if (!has(key)) return text;
  const std::string fault = address_fault(text);
  if (fault.empty()) return text;
  problem(key, fmt::format("'{}': {}", key, fault));
  return "";
}

std::filesystem::path TableReader::path(std::string_view key) {
  const KeySpec& s = spec(key, "path");
  const std::string text = text_of(s);
  if (!text.empty())
    return (std::filesystem::path(place_.file).parent_path() / text).lexically_normal();
  if (const toml::node* node = find(key);
      node && node->is_string() && node->as_string()->get().empty())
    problem(key, fmt::format("'{}' must name a file or folder", key));
  return {};
}

/// Whether a word is one of the key's range; else it is told.
bool TableReader::fits(const KeySpec& s, const toml::node& node, const std::string& word) {
  const auto words = words_of(s.range);
  if (std::find(words.begin(), words.end(), word) != words.end()) return true;
  std::string what =
      fmt::format("'{}' is \"{}\" but must be one of: {}", s.name, excerpt(word), s.range);
  if (const auto near = nearest_word(word, words)) what += fmt::format("; perhaps \"{}\"", *near);
  findings_.add(place_of(node, place_), std::move(what));
  return false;
}

std::string TableReader::choice(std::string_view key) {
  const KeySpec& s = spec(key, "choice");
  const std::string text = text_of(s);
  if (const toml::node* node = find(key); node && fits(s, *node, text)) return text;
  return std::string(unquoted(s.fallback));
}

/// The entries of a list, or the one value that stands for a list of one.
std::vector<const toml::node*> TableReader::listed(const KeySpec& s, const toml::node& node,
                                                   size_t most) {
  const toml::array* list = node.as_array();
  if (!list) return {&node};
  std::vector<const toml::node*> out;
  if (list->empty() || list->size() > most) {
    problem(s.name, fmt::format("'{}' must be one value, or a list of 1 to {}", s.name, most));
    return out;
  }
  for (const toml::node& entry : *list) out.push_back(&entry);
  return out;
}

std::vector<double> TableReader::numbers(std::string_view key, size_t most) {
  const auto it = specs_.find(key);
  const bool whole = it != specs_.end() && it->second->type == "integers";
  const KeySpec& s = spec(key, whole ? "integers" : "numbers");
  const toml::node* node = wanted(s);
  std::vector<double> out;
  if (node) {
    for (const toml::node* entry : listed(s, *node, most)) {
      const auto* integer = entry->as_integer();
      const auto* real = whole ? nullptr : entry->as_floating_point();
      if (!integer && !real) {
        wrong_type(s, *entry, whole ? "whole numbers" : "numbers");
        continue;
      }
      const double value = integer ? static_cast<double>(integer->get()) : real->get();
      if (!checked(s, *entry, value)) continue;
      if (std::find(out.begin(), out.end(), value) == out.end())
        out.push_back(value);
      else
        findings_.add(place_of(*entry, place_), fmt::format("'{}' says {} twice", key, value));
    }
  }
  if (out.empty()) out.push_back(inside(s));
  return out;
}

std::vector<std::string> TableReader::choices(std::string_view key, size_t most) {
  const KeySpec& s = spec(key, "choices");
  const toml::node* node = wanted(s);
  std::vector<std::string> out;
  if (node) {
    for (const toml::node* entry : listed(s, *node, most)) {
      const auto* word = entry->as_string();
      if (!word) {
        wrong_type(s, *entry, "words");
        continue;
      }
      if (!fits(s, *entry, word->get())) continue;
      if (std::find(out.begin(), out.end(), word->get()) == out.end())
        out.push_back(word->get());
      else
        findings_.add(place_of(*entry, place_),
                      fmt::format("'{}' says \"{}\" twice", key, word->get()));
    }
  }
  if (out.empty()) out.emplace_back(unquoted(s.fallback));
  return out;
}

std::vector<TableReader::Pair> TableReader::pairs(std::string_view key, size_t most) {
  const KeySpec& s = spec(key, "pairs");
  std::vector<Pair> out;
  const toml::node* node = wanted(s);
  if (!node) return out;
  const toml::array* rows = node->as_array();
  if (!rows || rows->size() > most) {
    problem(key, fmt::format("'{}' must be a list of at most {} pairs of names", key, most));
    return out;
  }
  for (const toml::node& row : *rows) {
    const toml::array* pair = row.as_array();
    const auto text_at = [&](size_t i) { return (*pair)[i].as_string(); };
    if (pair && pair->size() == 2 && text_at(0) && text_at(1)) {
      out.push_back({text_at(0)->get(), text_at(1)->get(), place_of(row, place_)});
    } else {
      findings_.add(place_of(row, place_), "a link is a pair of names: [\"n0\", \"n1\"]");
    }
  }
  return out;
}

std::vector<TableReader::Name> TableReader::names(std::string_view key, size_t most) {
  std::vector<Name> out;
  const toml::node* node = wanted(spec(key, "names"));
  if (!node) return out;
  const toml::array* list = node->as_array();
  if (!list || list->size() > most) {
    problem(key,
            fmt::format("'{}' must be a list of at most {} names: [\"n0\", \"n1\"]", key, most));
    return out;
  }
  for (const toml::node& entry : *list) {
    if (const auto* text = entry.as_string())
      out.push_back({text->get(), place_of(entry, place_)});
    else
      findings_.add(place_of(entry, place_), fmt::format("'{}' lists names: \"n0\"", key));
  }
  return out;
}

const toml::table& TableReader::table(std::string_view key) {
  static const toml::table empty;
  const KeySpec& s = spec(key, "table");
  const toml::node* node = wanted(s);
  if (!node) return empty;
  if (const auto* value = node->as_table()) return *value;
  wrong_type(s, *node, fmt::format("a table: [{}]", key));
  return empty;
}

std::vector<const toml::table*> TableReader::tables(std::string_view key, size_t most) {
  const KeySpec& s = spec(key, "tables");
  std::vector<const toml::table*> out;
  const toml::node* node = wanted(s);
  if (!node) return out;
  const toml::array* list = node->as_array();
  if (!list) {
    wrong_type(s, *node, fmt::format("a list of tables: [[{}]]", key));
    return out;
  }
  if (list->size() > most) {
    problem(key, fmt::format("there are {} tables '{}'; at most {} are allowed", list->size(), key,
                             most));
    return out;
  }
  for (const toml::node& node_of_list : *list) {
    if (const auto* value = node_of_list.as_table())
      out.push_back(value);
    else
      wrong_type(s, node_of_list, fmt::format("a list of tables: [[{}]]", key));
  }
  return out;
}

}  // namespace luxodus::config
