#include "runtime/toml/text_scan.hpp"

#include <algorithm>
#include <map>

namespace luxodus::toml {

namespace {

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

/// End of the comment that starts at `at`: the end of its line.
size_t after_comment(std::string_view text, size_t at) {
  while (at < text.size() && !ends_line(text[at])) ++at;
  return at;
}

/// End of the multi-line string whose three opening quotes are at `at`. Its content may end in one
/// or two quotes: five in a row also end it.
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

/// End of the string that starts at `at`; an unclosed one ends with its line.
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

/// End of the string or comment that starts at `at`; `at` if there is none.
size_t after_quiet(std::string_view text, size_t at) {
  if (text[at] == '#') return after_comment(text, at);
  return text[at] == '"' || text[at] == '\'' ? after_string(text, at) : at;
}

/// End of the bare word that starts at `at`; `at` if there is none.
size_t after_word(std::string_view text, size_t at) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  while (at < text.size() && bare(text[at])) ++at;
  return at;
}

/// Counts the dots in the current key and the open brackets.
class NestingDepth {
 public:
  /// Takes one character from outside strings and comments; false if the nesting is too deep.
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
  NestingDepth depth;
  for (size_t at = 0; at < text.size();) {
    if (const size_t behind = after_quiet(text, at); behind > at) {
      at = behind;
    } else if (depth.take(text[at])) {
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

std::string with_earlier_names(std::string_view text, const Schema& schema) {
  std::map<std::string_view, std::string_view> earlier;
  for (const TableSpec& table : schema.tables) {
    for (const KeySpec& key : table.keys) {
      if (!key.hashed_as.empty()) earlier[key.name] = key.hashed_as;
    }
  }
  std::string out;
  out.reserve(text.size());
  for (size_t at = 0; at < text.size();) {
    size_t behind = after_quiet(text, at);
    if (behind == at) behind = after_word(text, at);
    if (behind == at) ++behind;
    const std::string_view part = text.substr(at, behind - at);
    const auto renamed = earlier.find(part);
    out += renamed == earlier.end() ? part : renamed->second;
    at = behind;
  }
  return out;
}

}  // namespace luxodus::toml
