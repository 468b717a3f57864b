// Texts of tests with a word changed. Fails the test where the word is not there.
#pragma once

#include <catch2/catch.hpp>
#include <string>

namespace luxodus::test {

/// With the first `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// With every `from` replaced.
inline std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(text.find(from) != std::string::npos);
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace luxodus::test
