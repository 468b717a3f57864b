// Replaces words in texts of tests. Fails the test if the word is missing. Any thread.
#pragma once

#include <catch2/catch.hpp>
#include <string>

namespace luxodus::test {

/// The text with the first `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The text with every `from` replaced.
inline std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(text.find(from) != std::string::npos);
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace luxodus::test
