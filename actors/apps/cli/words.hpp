// Words and numbers as help, lists of keys, completion and messages of options show them. Pure.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace luxodus::cli {

/// As few digits as say it.
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  return text;
}

inline std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

/// Words of a text in lines of at most 90 columns, each but the first after `before` blanks.
std::string filled(const std::string& text, size_t before);

/// A name and what it means, as help lists both: the meaning in a column of its own.
std::string entry(const std::string& name, const std::string& meaning);

}  // namespace luxodus::cli
