// From text to values: the parser's results in our types, with lines.
#include "runtime/toml/document.hpp"

#include "tests/unit/runtime/toml/toml_kit.hpp"

namespace luxodus::toml {

TEST_CASE("every TOML type becomes a value with its line", "[runtime][toml]") {
  const Document document = parsed(
      "t = 'a'\ni = 7\nf = 1.5\nb = true\nd = 1979-05-27\nh = 07:32:00\n"
      "l = [1,\n 'x']\n[x.y]\nz = { q = 1 }\n");
  const Table& top = document.top;
  CHECK(top.place().file == "dir/lamp.toml");
  CHECK(*top.find("t")->as_text() == "a");
  CHECK(*top.find("i")->as_integer() == 7);
  CHECK(top.find("i")->as_number() == 7.0);
  CHECK(top.find("f")->as_number() == 1.5);
  CHECK(top.find("f")->as_integer() == nullptr);
  CHECK(*top.find("b")->as_flag());
  CHECK(top.find("d")->as_moment()->text == "1979-05-27");
  CHECK(top.find("d")->as_moment()->is_date);
  CHECK_FALSE(top.find("h")->as_moment()->is_date);
  CHECK(top.find("l")->as_list()->at(1).place().line == 8);
  CHECK(top.find("l")->kind() == "an array");
  const Table* inner = top.find("x")->as_table()->find("y")->as_table();
  REQUIRE(inner);
  CHECK(inner->find("z")->as_table()->find("q")->place().line == 10);
  CHECK(inner->entries().at(0).line == 10);
  CHECK(top.find("none") == nullptr);
}

TEST_CASE("values keep their place when their document moves", "[runtime][toml]") {
  Document first = parsed("a = 1\n");
  const Document second = std::move(first);
  CHECK(second.top.find("a")->place().file == "dir/lamp.toml");
}

TEST_CASE("invalid, too long or too deep TOML is one problem with its line", "[runtime][toml]") {
  const auto wrong = [](const std::string& text, QuotePolicy quoting = QuotePolicy::allowed) {
    const auto document = parse(text, "f.toml", 1000, quoting);
    return document ? std::string() : document.problem().text();
  };
  CHECK(wrong("a = 1\nb = ").starts_with("f.toml:2: this is not TOML: "));
  CHECK(wrong("secret", QuotePolicy::withheld) == "f.toml:1: this is not TOML");
  CHECK(wrong("a = 1\na = 2\n").starts_with("f.toml:2: this is not TOML: "));
  CHECK(wrong(std::string(1001, '\n')) ==
        "f.toml: this file is longer than 1000 bytes, the most that is read");
  CHECK(wrong("\nx = " + std::string(200, '[')).starts_with("f.toml:2: a key of more than 32 "));
  CHECK(wrong("").empty());
}

}  // namespace luxodus::toml
