// Schemas and their Markdown reference; nearest words and sizes.
#include "runtime/toml/schema.hpp"

#include "runtime/toml/words.hpp"
#include "tests/unit/runtime/toml/toml_kit.hpp"

namespace luxodus::toml {

TEST_CASE("a schema is printed as a heading and a table of keys for each table",
          "[runtime][toml]") {
  const Schema schema{{{"a",
                        "`[a]`",
                        {{"x", "number", "m", "1", "[0, 2]", "a width"},
                         {"y", "choice", "", "\"u\"", "u, v", "a word"}}},
                       {"b", "`[b]`", {}}}};
  CHECK(schema_markdown(schema) ==
        "### `[a]`\n\n"
        "| key | type | unit | default | range | meaning |\n|---|---|---|---|---|---|\n"
        "| `x` | number | m | 1 | [0, 2] | a width |\n"
        "| `y` | choice |  | \"u\" | u, v | a word |\n\n"
        "### `[b]`\n\nNo further keys.\n\n");
  CHECK(schema.key("a", "y").fallback == "\"u\"");
  CHECK_THROWS_AS(schema.table("c"), std::logic_error);
  CHECK_THROWS_AS(schema.key("a", "z"), std::logic_error);
}

TEST_CASE("a range contains its ends if they are closed", "[runtime][toml]") {
  const auto range = interval_of("(0, 1e3]");
  REQUIRE(range.has_value());
  CHECK_FALSE(range->holds(0));
  CHECK(range->holds(1000));
  CHECK_FALSE(interval_of("[0, 1)")->holds(1));
  for (const char* wrong : {"", "[0, 1", "0, 1", "[a, b]", "[0 1]", "warm, cold"}) {
    INFO(wrong);
    CHECK_FALSE(interval_of(wrong).has_value());
  }
  CHECK(words_of("warm,  cold") == std::vector<std::string_view>{"warm", "cold"});
  CHECK(words_of("").empty());
}

TEST_CASE("sizes are parsed as people write them", "[runtime][toml]") {
  CHECK(bytes_in("4096") == 4096.0);
  CHECK(bytes_in("512 MiB") == 512.0 * 1024 * 1024);
  CHECK(bytes_in("1.5GB") == 1.5e9);
  for (const char* wrong : {"", "MiB", "1 XB", "1 MiB ", "1 2", "one"}) {
    INFO(wrong);
    CHECK_FALSE(bytes_in(wrong).has_value());
  }
}

TEST_CASE("the nearest word is the intended one, or none", "[runtime][toml]") {
  const std::vector<std::string_view> keys{"object_bytes", "tally_bytes", "fibers", "port"};
  CHECK(nearest_word("objects_bytes", keys) == "object_bytes");
  CHECK(nearest_word("fibres", keys) == "fibers");
  CHECK(nearest_word("prot", keys) == "port");
  CHECK_FALSE(nearest_word("colour", keys).has_value());
  CHECK(nearest_word("reflectivity", {"name", "reflectance", "roughness"}) == "reflectance");
  CHECK_FALSE(nearest_word("reflect_xyzabc", {"reflectance", "reflector_k"}));
  CHECK_FALSE(nearest_word(std::string(100000, 'x'), keys).has_value());
  const std::vector<std::string_view> materials{"reflectance", "roughness", "ior"};
  CHECK(nearest_word("reflectence", materials) == "reflectance");
  CHECK(nearest_word("oir", materials) == "ior");
  CHECK_FALSE(nearest_word("transparency", materials).has_value());
  CHECK_FALSE(nearest_word("n9", {"n0"}).has_value());  // half of it is wrong, not a third
  CHECK_FALSE(nearest_word("m", {"n"}).has_value());    // nothing of "n" would be left
}

}  // namespace luxodus::toml
