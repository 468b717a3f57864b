#include "actors/apps/cli/words.hpp"

#include <sstream>

namespace luxodus::cli {

namespace {

constexpr size_t help_columns = 90;
/// The column of descriptions; a longer name gets a line of its own.
constexpr size_t meaning_column = 30;

}  // namespace

std::string filled(const std::string& text, size_t before) {
  std::string out;
  size_t column = before;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!out.empty() && column + 1 + word.size() > help_columns) {
      out += "\n" + std::string(before, ' ') + word;
      column = before + word.size();
    } else {
      out += (out.empty() ? "" : " ") + word;
      column += word.size() + 1;
    }
  }
  return out;
}

std::string entry(const std::string& name, const std::string& meaning) {
  std::string out = "  " + name;
  if (out.size() + 2 > meaning_column)
    out += "\n" + std::string(meaning_column, ' ');
  else
    out.resize(meaning_column, ' ');
  return out + filled(meaning, meaning_column) + "\n";
}

}  // namespace luxodus::cli
