#include "runtime/core/result.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

TEST_CASE("a problem prints as file:line: sentence, and without a line as file: sentence",
          "[core]") {
  CHECK(Problem{{"a.toml", 7}, "unknown key"}.text() == "a.toml:7: unknown key");
  CHECK(Problem{{"a.png", 0}, "not a PNG"}.text() == "a.png: not a PNG");
  CHECK(Problem{{}, "no scene given"}.text() == "no scene given");
}

TEST_CASE("a result holds either its value or its problem", "[core]") {
  Result<int> good = 3;
  Result<int> bad = Problem{{}, "no"};
  REQUIRE(good.ok());
  CHECK(good.value() == 3);
  REQUIRE_FALSE(bad.ok());
  CHECK(bad.problem().what == "no");
}
