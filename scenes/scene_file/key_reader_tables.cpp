// The keys whose values are tables, words or files.
#include "scenes/scene_file/key_reader.hpp"

namespace luxodus {

const toml::node* KeyReader::node(std::string_view key) {
  return needed(spec(key));
}

const toml::table* KeyReader::table(std::string_view key) {
  const KeySpec& s = spec(key, "table");
  const toml::node* n = needed(s);
  if (!n) return nullptr;
  if (const toml::table* t = n->as_table()) return t;
  wrong_type(s, *n, "a table");
  return nullptr;
}

std::vector<const toml::table*> KeyReader::tables(std::string_view key) {
  const KeySpec& s = spec(key, "tables");
  std::vector<const toml::table*> out;
  const toml::node* n = needed(s);
  if (!n) return out;
  const toml::array* a = n->as_array();
  if (!a) {
    const std::string should =
        "a list of tables, each opened by [[" + std::string(key) + "]] or written { ... }";
    wrong_type(s, *n, should.c_str());
    return out;
  }
  if (a->size() > scene_limits::tables_per_kind) {
    problem(key, "there are " + std::to_string(a->size()) + " tables '" + std::string(key) +
                     "'; at most " + std::to_string(scene_limits::tables_per_kind) +
                     " are allowed");
    return out;
  }
  for (const toml::node& e : *a) {
    if (const toml::table* t = e.as_table()) {
      out.push_back(t);
    } else {
      wrong_type(s, e, "a list of tables");
      return out;
    }
  }
  return out;
}

std::vector<KeyReader::Factor> KeyReader::factors(std::string_view key) {
  const KeySpec& s = spec(key, "factors");
  std::vector<Factor> out;
  const toml::node* n = needed(s);
  if (!n) return out;
  const toml::table* t = n->as_table();
  if (!t) {
    wrong_type(s, *n, "a table of name = number");
    return out;
  }
  for (auto&& [name, value] : *t) {
    const std::string which = " of '" + std::string(name.str()) + "'";
    if (const auto v = checked(key, value, which.c_str())) {
      out.push_back({std::string(name.str()), *v, place_of(value, place_)});
    }
  }
  return out;
}

std::vector<KeyReader::Word> KeyReader::words(std::string_view key) {
  const KeySpec& s = spec(key, "words");
  std::vector<Word> out;
  const toml::node* n = needed(s);
  if (!n) return out;
  const toml::table* t = n->as_table();
  if (!t) {
    wrong_type(s, *n, "a table of name = \"text\"");
    return out;
  }
  for (auto&& [name, value] : *t) {
    if (const auto* w = value.as_string()) {
      out.push_back({std::string(name.str()), w->get(), place_of(value, place_)});
    } else {
      wrong_type(s, value, "a table of name = \"text\"");
    }
  }
  return out;
}

std::optional<std::filesystem::path> KeyReader::existing(const toml::node& n,
                                                         const std::string& text) {
  namespace fs = std::filesystem;
  const SourcePlace at = place_of(n, place_);
  const fs::path full = (fs::path(at.file).parent_path() / fs::path(text)).lexically_normal();
  std::error_code error;
  const auto status = fs::status(full, error);
  std::string what;
  if (text.empty() || text.find('\0') != std::string::npos) {
    what = "an empty text names no file";
  } else if (!fs::exists(status)) {
    what = "there is no file '" + text + "' (looked for " + full.string() + ")";
  } else if (!fs::is_regular_file(status)) {
    what = "'" + text + "' is not a file (" + full.string() + ")";
  } else {
    return full;
  }
  clean_ = false;
  reading_.problem(at, std::move(what));
  return std::nullopt;
}

std::optional<std::filesystem::path> KeyReader::path(std::string_view key) {
  const KeySpec& s = spec(key, "path");
  const toml::node* n = needed(s);
  if (!n) return std::nullopt;
  if (const auto* t = n->as_string()) return existing(*n, t->get());
  wrong_type(s, *n, "the path of a file");
  return std::nullopt;
}

std::vector<std::pair<std::filesystem::path, SourcePlace>> KeyReader::paths(std::string_view key) {
  const KeySpec& s = spec(key, "paths");
  std::vector<std::pair<std::filesystem::path, SourcePlace>> out;
  const toml::array* a = list(s);
  if (!a) return out;
  for (const toml::node& e : *a) {
    const auto* t = e.as_string();
    if (!t) {
      wrong_type(s, e, "a list of paths");
      continue;
    }
    if (auto full = existing(e, t->get())) out.emplace_back(std::move(*full), place_of(e, place_));
  }
  return out;
}

}  // namespace luxodus
