// Words and numbers as help, completion and messages of options show them. Pure.
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

}  // namespace luxodus::cli
