#include "runtime/core/result.hpp"

#include <catch2/catch.hpp>

#include "runtime/core/printable.hpp"

using namespace luxodus;

TEST_CASE("a problem prints as file:line: sentence, and without a line as file: sentence",
          "[core]") {
  CHECK(Problem{{"a.toml", 7}, "unknown key"}.text() == "a.toml:7: unknown key");
  CHECK(Problem{{"a.png", 0}, "not a PNG"}.text() == "a.png: not a PNG");
  CHECK(Problem{{}, "no scene given"}.text() == "no scene given");
}

TEST_CASE("a problem's text is one line without terminal control characters", "[core]") {
  const std::string nul(1, '\0');
  CHECK(Problem{{"a.toml", 1}, "no '\x1b[31m" + nul + "\n\x7f'"}.text() ==
        "a.toml:1: no '\\x1B[31m\\x00\\x0A\\x7F'");
  CHECK(Problem{{"evil\nname", 0}, "x"}.text() == "evil\\x0Aname: x");
  CHECK(Problem{{}, "\xC2\x9B[2J"}.text() == "\\xC2\\x9B[2J");
  const std::string umlauts = "\xC3\xA4 \xC2\xB0 \xE2\x82\xAC \xC2";  // the last is cut off
  CHECK(Problem{{}, umlauts}.text() == umlauts);
}

TEST_CASE("printable text keeps the characters that its layout needs", "[core]") {
  CHECK(printable("a\tb\n\x1b[2J", "\n\t") == "a\tb\n\\x1B[2J");
  CHECK(printable("\xC2\x9B", "\n\t") == "\\xC2\\x9B");
}

TEST_CASE("a result holds either its value or its problem", "[core]") {
  Result<int> good = 3;
  Result<int> bad = Problem{{}, "no"};
  REQUIRE(good.ok());
  CHECK(good.value() == 3);
  REQUIRE_FALSE(bad.ok());
  CHECK(bad.problem().what == "no");
}

TEST_CASE("an excerpt is short and has only valid characters", "[core]") {
  CHECK(excerpt("LM-63-1999") == "LM-63-1999");
  CHECK(excerpt("\x1b[31mred\n") == "\\x1B[31mred\\x0A");
  CHECK(excerpt("Lampe \xC3\xA4 \xC2\x9B") == "Lampe \xC3\xA4 \\xC2\\x9B");
  CHECK(excerpt("\xFF\xC3") == "\\xFF\\xC3");  // no UTF-8
  CHECK(excerpt(std::string(60, 'a')) == std::string(60, 'a'));
  CHECK(excerpt(std::string(1000, 'a')) == std::string(60, 'a') + "...");
  // No character is split.
  CHECK(excerpt(std::string(59, 'a') + "\xC3\xA4") == std::string(59, 'a') + "...");
}
