#include "runtime/toml/text_scan.hpp"

#include <algorithm>
#include <map>

namespace luxodus::toml {

namespace {

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

/// Where a comment that starts at `at` ends: at its line's end.
size_t after_comment(std::string_view text, size_t at) {
  while (at < text.size() && !ends_line(text[at])) ++at;
  return at;
}

/// Behind the string of several lines whose three opening quotes stand at `at`. The last of its
/// content may be one or two quotes: five in a row end it as well as three.
size_t after_long_string(std::string_view text, size_t at) {
  const char quote = text[at];
  const bool escapes = quote == '"';
  size_t quotes = 0;
  for (at += 3; at < text.size(); ++at) {
    if (text[at] == quote) {
      if (++quotes == 5) return at + 1;
      continue;
    }
    if (quotes >= 3) return at;
    quotes = 0;
    if (escapes && text[at] == '\\') ++at;
  }
  return text.size();
}

/// Behind the string that starts at `at`; one that is not closed ends with its line.
size_t after_string(std::string_view text, size_t at) {
  const char quote = text[at];
  if (text.substr(at, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''"))
    return after_long_string(text, at);
  const bool escapes = quote == '"';
  for (++at; at < text.size() && !ends_line(text[at]); ++at) {
    if (text[at] == quote) return at + 1;
    if (escapes && text[at] == '\\' && at + 1 < text.size() && !ends_line(text[at + 1])) ++at;
  }
  return at;
}

/// Behind the string or comment that starts at `at`; `at` where none does.
size_t after_quiet(std::string_view text, size_t at) {
  if (text[at] == '#') return after_comment(text, at);
  return text[at] == '"' || text[at] == '\'' ? after_string(text, at) : at;
}

/// Behind the bare word that starts at `at`; `at` where none does.
size_t after_word(std::string_view text, size_t at) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  while (at < text.size() && bare(text[at])) ++at;
  return at;
}

/// Counts the dots since the last sign that ends a key, and the brackets that are open.
class Nesting {
 public:
  /// Takes one character from outside strings and comments; false where it goes too deep.
  bool take(char c) {
    switch (c) {
      case '.':
        return ++dots_ <= limits::toml_nesting;
      case '[':
      case '{':
        dots_ = 0;
        return ++open_ <= limits::toml_nesting;
      case ']':
      case '}':
        if (open_ > 0) --open_;
        [[fallthrough]];
      case '=':
      case ',':
      case '\n':
      case '\r':
        dots_ = 0;
        return true;
      default:
        return true;
    }
  }

 private:
  size_t dots_ = 0, open_ = 0;
};

}  // namespace

Result<void> check_nesting(std::string_view text, const std::string& file) {
  Nesting nesting;
  for (size_t at = 0; at < text.size();) {
    if (const size_t behind = after_quiet(text, at); behind > at) {
      at = behind;
    } else if (nesting.take(text[at])) {
      ++at;
    } else {
      const auto lines = std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(at), '\n');
      return problem_in(
          file, 1 + static_cast<int>(lines),
          "a key of more than " + std::to_string(limits::toml_nesting) +
              " dots, or as many brackets one in another: tables do not nest so deep");
    }
  }
  return {};
}

std::string with_oldest_names(std::string_view text, const Schema& schema) {
  std::map<std::string_view, std::string_view> oldest;
  for (const TableSpec& table : schema.tables) {
    for (const KeySpec& key : table.keys) {
      const auto names = words_of(key.formerly);
      if (names.empty()) continue;
      oldest[key.name] = names.front();
      for (const auto name : names) oldest[name] = names.front();
    }
  }
  std::string out;
  out.reserve(text.size());
  for (size_t at = 0; at < text.size();) {
    size_t behind = after_quiet(text, at);
    if (behind == at) behind = after_word(text, at);
    if (behind == at) ++behind;
    const std::string_view part = text.substr(at, behind - at);
    const auto renamed = oldest.find(part);
    out += renamed == oldest.end() ? part : renamed->second;
    at = behind;
  }
  return out;
}

}  // namespace luxodus::toml
