#include "scenes/format/key_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "runtime/core/printable.hpp"

namespace luxodus {

namespace {

/// Shortest text that reads well: 0.5, 2, 1e+07.
std::string shown(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", v);
  return text;
}

std::string in_quotes(std::string_view key) {
  return "'" + excerpt(key) + "'";
}

std::string with_unit(const KeySpec& spec) {
  return spec.unit.empty() ? std::string() : " " + std::string(spec.unit);
}

std::string list_words(std::string_view range) {
  std::string out;
  for (const auto w : words_of(range)) out += (out.empty() ? "\"" : ", \"") + std::string(w) + "\"";
  return out;
}

/// Control characters and separators of paths have no place in what becomes a file's name.
bool is_good_name(std::string_view name) {
  if (name.empty() || name.size() > scene_limits::name_chars) return false;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 0x20 || u == 0x7f || c == '/' || c == '\\' || c == '"') return false;
  }
  return name.front() != ' ' && name.back() != ' ' && name.front() != '.';
}

std::vector<double> literal_numbers(std::string_view text) {
  std::vector<double> out;
  std::string s(text);
  for (char& c : s) {
    if (c == '[' || c == ']' || c == ',') c = ' ';
  }
  const char* at = s.c_str();
  for (char* end = nullptr;; at = end) {
    const double v = std::strtod(at, &end);
    if (end == at) return out;
    out.push_back(v);
  }
}

}  // namespace

SourcePlace place_of(const toml::node& node, const SourcePlace& fallback) {
  const toml::source_region& region = node.source();
  SourcePlace place = fallback;
  if (region.path) place.file = *region.path;
  if (region.begin.line > 0) place.line = static_cast<int>(region.begin.line);
  return place;
}

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

std::optional<double> number_in(const toml::node& node) {
  if (const auto* i = node.as_integer()) return static_cast<double>(i->get());
  if (const auto* f = node.as_floating_point()) return f->get();
  return std::nullopt;
}

KeyReader::KeyReader(const toml::table& table, const std::vector<std::string>& specs,
                     SceneReading& reading, const SourcePlace& fallback)
    : table_(table), reading_(reading), place_(place_of(table, fallback)) {
  std::vector<std::string> known;
  for (const std::string& name : specs) {
    for (const KeySpec& k : table_spec(name).keys) {
      specs_.emplace(k.name, &k);
      known.emplace_back(k.name);
    }
  }
  for (auto&& [key, value] : table) {
    if (specs_.count(std::string_view(key)) > 0) values_.emplace(key, &value);
  }
  for (auto&& [key, value] : table) {
    const std::string_view name = key;
    if (specs_.count(name) > 0) continue;
    SourcePlace at = place_of(value, place_);
    if (key.source().begin.line > 0) at.line = static_cast<int>(key.source().begin.line);
    std::string what = "unknown key " + in_quotes(name);
    const auto near = nearest_word(name, known);
    if (near) {
      what += "; did you mean " + in_quotes(*near) + "?";
      values_.emplace(*near, &value);  // no effect where the right key stands too
    } else {
      what += "; known here:";
      for (const auto& k : known) what += " " + k;
    }
    clean_ = false;
    reading_.problem(std::move(at), std::move(what));
  }
}

const toml::node* KeyReader::find(std::string_view key) const {
  const auto it = values_.find(key);
  return it == values_.end() ? nullptr : it->second;
}

const KeySpec& KeyReader::spec(std::string_view key) const {
  const auto it = specs_.find(key);
  if (it == specs_.end()) throw std::logic_error("no key '" + std::string(key) + "' in the schema");
  return *it->second;
}

const KeySpec& KeyReader::spec(std::string_view key, std::string_view type) const {
  const KeySpec& s = spec(key);
  if (s.type != type) {
    throw std::logic_error("key '" + std::string(key) + "' is a " + std::string(s.type) +
                           " in the schema, read as a " + std::string(type));
  }
  return s;
}

SourcePlace KeyReader::place(std::string_view key) const {
  const toml::node* n = find(key);
  return n ? place_of(*n, place_) : place_;
}

void KeyReader::problem(std::string_view key, const std::string& what) {
  clean_ = false;
  reading_.problem(place(key), what);
}

void KeyReader::problem(const std::string& what) {
  clean_ = false;
  reading_.problem(place_, what);
}

const toml::node* KeyReader::needed(const KeySpec& s) {
  const toml::node* n = find(s.name);
  if (!n && s.fallback == "required") {
    problem("the key " + in_quotes(s.name) + " is missing: " + std::string(s.meaning));
  }
  return n;
}

void KeyReader::wrong_type(const KeySpec& s, const toml::node& n, const char* should) {
  clean_ = false;
  reading_.problem(place_of(n, place_),
                   in_quotes(s.name) + " must be " + should + ", not " + kind_of(n));
}

std::optional<double> KeyReader::default_number(std::string_view key) const {
  const auto literal = literal_numbers(spec(key).fallback);
  return literal.size() == 1 ? std::optional(literal[0]) : std::nullopt;
}

std::optional<std::string> KeyReader::default_text(std::string_view key) const {
  const std::string_view f = spec(key).fallback;
  if (f.size() < 2 || f.front() != '"') return std::nullopt;
  return std::string(f.substr(1, f.size() - 2));
}

double KeyReader::inside(const KeySpec& s) {
  if (const auto literal = literal_numbers(s.fallback); literal.size() == 1) return literal[0];
  const auto range = interval_of(s.range);
  if (!range) return 1;
  if (range->holds(1)) return 1;
  return 0.5 * (range->low + range->high);
}

std::optional<double> KeyReader::checked(std::string_view key, const toml::node& n,
                                         const char* what) {
  const KeySpec& s = spec(key);
  const auto v = number_in(n);
  const std::string subject = in_quotes(key) + what;
  if (!v) {
    clean_ = false;
    reading_.problem(place_of(n, place_), subject + " must be a number, not " + kind_of(n));
    return std::nullopt;
  }
  std::string wrong;
  if (!std::isfinite(*v)) {
    wrong = subject + " must be a finite number, not " + shown(*v);
  } else if (const auto range = interval_of(s.range); range && !range->holds(*v)) {
    wrong =
        subject + " is " + shown(*v) + " but must lie in " + std::string(s.range) + with_unit(s);
    if (s.unit == "m" && *v > range->high)
      wrong += "; metres? " + shown(*v) + " mm is " + shown(*v / 1000);
  }
  if (wrong.empty()) return v;
  clean_ = false;
  reading_.problem(place_of(n, place_), std::move(wrong));
  return std::nullopt;
}

std::optional<double> KeyReader::maybe_number(std::string_view key) {
  const KeySpec& s = spec(key, "number");
  const toml::node* n = needed(s);
  return n ? checked(key, *n) : default_number(key);
}

double KeyReader::number(std::string_view key) {
  return maybe_number(key).value_or(inside(spec(key)));
}

std::optional<int64_t> KeyReader::maybe_integer(std::string_view key) {
  const KeySpec& s = spec(key, "integer");
  const toml::node* n = needed(s);
  if (!n) {
    const auto fallback = default_number(key);
    return fallback ? std::optional(static_cast<int64_t>(*fallback)) : std::nullopt;
  }
  if (!n->is_integer()) {
    wrong_type(s, *n, "a whole number");
    return std::nullopt;
  }
  if (!checked(key, *n)) return std::nullopt;
  return n->as_integer()->get();
}

int64_t KeyReader::integer(std::string_view key) {
  return maybe_integer(key).value_or(static_cast<int64_t>(inside(spec(key))));
}

bool KeyReader::flag(std::string_view key) {
  const KeySpec& s = spec(key, "flag");
  const bool fallback = s.fallback == "true";
  const toml::node* n = needed(s);
  if (!n) return fallback;
  if (const auto* b = n->as_boolean()) return b->get();
  wrong_type(s, *n, "true or false");
  return fallback;
}

std::optional<std::string> KeyReader::maybe_text(std::string_view key) {
  const KeySpec& s = spec(key);
  if (s.type != "text" && s.type != "name") spec(key, "text");
  const toml::node* n = needed(s);
  if (!n) {
    return default_text(key);
  }
  const auto* t = n->as_string();
  if (!t) {
    wrong_type(s, *n, "a text");
    return std::nullopt;
  }
  const std::string& value = t->get();
  if (s.type == "name" && !is_good_name(value)) {
    problem(key, in_quotes(key) + " must be 1 to " + std::to_string(scene_limits::name_chars) +
                     " characters without control characters, quotes, slashes, a leading dot or "
                     "outer spaces");
    return std::nullopt;
  }
  if (value.size() > scene_limits::list_values) {
    problem(key, in_quotes(key) + " is longer than " + std::to_string(scene_limits::list_values) +
                     " characters");
    return std::nullopt;
  }
  return value;
}

std::string KeyReader::text(std::string_view key) {
  return maybe_text(key).value_or("");
}

std::optional<std::string> KeyReader::maybe_choice(std::string_view key) {
  const KeySpec& s = spec(key, "choice");
  const toml::node* n = needed(s);
  if (!n) {
    return default_text(key);
  }
  const auto words = words_of(s.range);
  if (const auto* b = n->as_boolean()) {
    // A choice that knows true and false takes them without quotes.
    const std::string word = b->get() ? "true" : "false";
    if (std::find(words.begin(), words.end(), word) != words.end()) return word;
  }
  const auto* t = n->as_string();
  if (!t) {
    const std::string should = "one of " + list_words(s.range);
    wrong_type(s, *n, should.c_str());
    return std::nullopt;
  }
  std::vector<std::string> known;
  for (const auto w : words) {
    if (w == t->get()) return t->get();
    known.emplace_back(w);
  }
  std::string what = in_quotes(key) + " is \"" + excerpt(t->get()) + "\" but must be one of " +
                     list_words(s.range);
  if (const auto near = nearest_word(t->get(), known)) what += "; did you mean \"" + *near + "\"?";
  problem(key, what);
  return std::nullopt;
}

std::string KeyReader::choice(std::string_view key) {
  const KeySpec& s = spec(key);
  const auto chosen = maybe_choice(key);
  if (chosen) return *chosen;
  return default_text(key).value_or(std::string(words_of(s.range).front()));
}

std::optional<std::vector<double>> KeyReader::components(const KeySpec& s, size_t count) {
  const toml::node* n = needed(s);
  if (!n) {
    auto literal = literal_numbers(s.fallback);
    return literal.size() == count ? std::optional(std::move(literal)) : std::nullopt;
  }
  const toml::array* a = n->as_array();
  if (!a || a->size() != count) {
    clean_ = false;
    reading_.problem(place_of(*n, place_),
                     in_quotes(s.name) + " must be a list of " + std::to_string(count) +
                         " numbers, not " + (a ? "of " + std::to_string(a->size()) : kind_of(*n)));
    return std::nullopt;
  }
  std::vector<double> out;
  for (const toml::node& e : *a) {
    const auto v = checked(s.name, e);
    if (!v) return std::nullopt;
    out.push_back(*v);
  }
  return out;
}

std::optional<glm::dvec2> KeyReader::maybe_pair(std::string_view key) {
  const auto c = components(spec(key, "pair"), 2);
  return c ? std::optional(glm::dvec2((*c)[0], (*c)[1])) : std::nullopt;
}

glm::dvec2 KeyReader::pair(std::string_view key) {
  return maybe_pair(key).value_or(glm::dvec2(inside(spec(key))));
}

std::optional<glm::dvec3> KeyReader::maybe_point(std::string_view key) {
  const auto c = components(spec(key, "point"), 3);
  return c ? std::optional(glm::dvec3((*c)[0], (*c)[1], (*c)[2])) : std::nullopt;
}

glm::dvec3 KeyReader::point(std::string_view key) {
  return maybe_point(key).value_or(glm::dvec3(inside(spec(key))));
}

std::optional<glm::dvec3> KeyReader::maybe_direction(std::string_view key) {
  const auto c = components(spec(key, "direction"), 3);
  if (!c) return std::nullopt;
  const glm::dvec3 v((*c)[0], (*c)[1], (*c)[2]);
  if (glm::length(v) < 1e-9) {
    problem(key, in_quotes(key) + " must not be the zero vector");
    return std::nullopt;
  }
  return glm::normalize(v);
}

glm::dvec3 KeyReader::direction(std::string_view key) {
  return maybe_direction(key).value_or(glm::dvec3(0, 0, 1));
}

const toml::array* KeyReader::list(const KeySpec& s) {
  const toml::node* n = needed(s);
  if (!n) return nullptr;
  const toml::array* a = n->as_array();
  if (!a) {
    wrong_type(s, *n, "a list");
    return nullptr;
  }
  if (a->size() > scene_limits::list_values) {
    problem(s.name, in_quotes(s.name) + " has " + std::to_string(a->size()) + " values; at most " +
                        std::to_string(scene_limits::list_values) + " are allowed");
    return nullptr;
  }
  return a;
}

std::vector<double> KeyReader::numbers(std::string_view key) {
  std::vector<double> out;
  const toml::array* a = list(spec(key, "numbers"));
  if (!a) return out;
  for (const toml::node& e : *a) {
    const auto v = checked(key, e);
    if (!v) return {};
    out.push_back(*v);
  }
  return out;
}

std::vector<std::string> KeyReader::texts(std::string_view key) {
  const KeySpec& s = spec(key, "texts");
  std::vector<std::string> out;
  const toml::array* a = list(s);
  if (!a) return out;
  for (const toml::node& e : *a) {
    const auto* t = e.as_string();
    if (!t || t->get().empty()) {
      wrong_type(s, e, t ? "a list of texts that are not empty" : "a list of texts");
      return {};
    }
    out.push_back(t->get());
  }
  return out;
}

std::vector<glm::dvec2> KeyReader::pairs(std::string_view key) {
  return rows(spec(key, "pairs"), false);
}

std::vector<glm::dvec2> KeyReader::corners(std::string_view key) {
  return rows(spec(key, "corners"), true);
}

std::vector<glm::dvec3> KeyReader::points(std::string_view key) {
  const KeySpec& s = spec(key, "points");
  std::vector<glm::dvec3> out;
  const toml::array* a = list(s);
  if (!a) return out;
  for (const toml::node& e : *a) {
    const toml::array* row = e.as_array();
    if (!row || row->size() != 3) {
      clean_ = false;
      reading_.problem(place_of(e, place_), in_quotes(key) + " must be a list of points [x, y, z]");
      return {};
    }
    glm::dvec3 point(0);
    for (int i = 0; i < 3; ++i) {
      const auto value = checked(key, (*row)[static_cast<size_t>(i)]);
      if (!value) return {};
      point[i] = *value;
    }
    out.push_back(point);
  }
  return out;
}

glm::dvec3 KeyReader::scale(std::string_view key) {
  const KeySpec& s = spec(key, "scale");
  const toml::node* n = needed(s);
  if (!n) return glm::dvec3(inside(s));
  if (n->is_array()) {
    const auto c = components(s, 3);
    return c ? glm::dvec3((*c)[0], (*c)[1], (*c)[2]) : glm::dvec3(inside(s));
  }
  return glm::dvec3(checked(key, *n).value_or(inside(s)));
}

std::vector<glm::dvec2> KeyReader::rows(const KeySpec& s, bool range_of_both) {
  const std::string_view key = s.name;
  std::vector<glm::dvec2> out;
  const toml::array* a = list(s);
  if (!a) return out;
  for (const toml::node& e : *a) {
    const toml::array* row = e.as_array();
    if (!row || row->size() != 2) {
      clean_ = false;
      reading_.problem(place_of(e, place_),
                       in_quotes(key) + " must be a list of rows of two numbers");
      return {};
    }
    const auto first = number_in((*row)[0]);
    if (!first || !std::isfinite(*first)) {
      clean_ = false;
      reading_.problem(place_of((*row)[0], place_),
                       in_quotes(key) + " must hold finite numbers, not " +
                           (first ? shown(*first) : kind_of((*row)[0])));
      return {};
    }
    if (range_of_both && !checked(key, (*row)[0])) return {};
    const auto second = checked(key, (*row)[1]);
    if (!second) return {};
    out.emplace_back(*first, *second);
  }
  return out;
}

std::string KeyReader::exactly_one(std::initializer_list<std::string_view> keys, bool is_needed) {
  std::string given, all;
  int count = 0;
  for (const auto k : keys) {
    all += (all.empty() ? "" : ", ") + in_quotes(k);
    if (!has(k)) continue;
    ++count;
    if (count == 2) {
      problem(k,
              in_quotes(k) + " and " + in_quotes(given) + " say the same thing; keep one of them");
    }
    if (count == 1) given = k;
  }
  if (count == 0 && is_needed) problem("one of the keys " + all + " is needed");
  return count == 1 ? given : std::string();
}

std::string read_name(KeyReader& keys, std::string_view kind) {
  const auto name = keys.maybe_text("name");
  if (!name) {
    // Its name is unknown, so nothing that refers to this kind can be called wrong.
    keys.reading().incomplete = true;
    return "";
  }
  keys.reading().declare(kind, *name, keys.place("name"));
  return *name;
}

std::string table_choice(const toml::table& table, std::string_view spec, std::string_view key) {
  for (const KeySpec& k : table_spec(spec).keys) {
    if (k.name != key) continue;
    if (!table.contains(key)) {
      const bool literal = k.fallback.size() > 2 && k.fallback.front() == '"';
      return literal ? std::string(k.fallback.substr(1, k.fallback.size() - 2)) : std::string();
    }
    const auto* t = table[key].as_string();
    const auto words = words_of(k.range);
    return t && std::find(words.begin(), words.end(), t->get()) != words.end() ? t->get()
                                                                               : std::string();
  }
  throw std::logic_error("no key '" + std::string(key) + "' in table " + std::string(spec));
}

KeyReader kind_reader(const toml::table& table, const std::string& base, std::string_view key,
                      SceneReading& reading, std::string& kind) {
  kind = table_choice(table, base, key);
  std::vector<std::string> specs = {base};
  for (const KeySpec& k : table_spec(base).keys) {
    if (k.name != key) continue;
    for (const auto word : words_of(k.range)) {
      if (kind.empty() || kind == word) specs.push_back(base + "." + std::string(word));
    }
  }
  KeyReader keys(table, specs, reading);
  if (kind.empty()) keys.maybe_choice(key);
  return keys;
}

}  // namespace luxodus
