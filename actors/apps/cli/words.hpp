// Formats words and numbers for help, lists of keys, completion and messages of options. Pure; any
// thread.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace luxodus::cli {

/// With as few digits as needed.
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

/// Fills a text to lines of at most 90 columns, each but the first after `before` blanks.
std::string filled(const std::string& text, size_t before);

/// A name and its meaning, as a line of the help: the meaning in a column of its own.
std::string entry(const std::string& name, const std::string& meaning);

}  // namespace luxodus::cli
