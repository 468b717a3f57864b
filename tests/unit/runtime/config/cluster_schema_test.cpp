// The README of cluster files matches the reader: its tables are the schema's, and its example is
// valid.
#include "runtime/config/cluster_schema.hpp"

#include <fstream>
#include <sstream>

#include "runtime/toml/words.hpp"
#include "tests/unit/runtime/config/cluster_kit.hpp"

namespace luxodus {
namespace {

std::string readme() {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/runtime/config/README.md");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the README ends with every table and key of the schema, word for word",
          "[runtime][config]") {
  const std::string text = readme();
  const size_t from = text.find("### ");
  REQUIRE(from != std::string::npos);
  std::istringstream said(text.substr(from)),
      meant(toml::schema_markdown(config::cluster_schema()));
  for (std::string meant_line, said_line; std::getline(meant, meant_line);) {
    std::getline(said, said_line);
    REQUIRE(said_line == meant_line);
  }
  CHECK(said.peek() == EOF);
}

TEST_CASE("every type of the schema is explained, and every default is in its range",
          "[runtime][config]") {
  const std::string text = readme();
  const size_t from = text.find("## Every table and key");
  const std::string types = text.substr(from, text.find("### ") - from);
  for (const toml::TableSpec& table : config::cluster_schema().tables) {
    CHECK_FALSE(table.keys.empty());
    for (const toml::KeySpec& key : table.keys) {
      INFO(table.name << "." << key.name);
      CHECK(types.find(std::string(key.type)) != std::string::npos);
      CHECK_FALSE(key.meaning.empty());
      const bool counted = key.type == "integer" || key.type == "number" || key.type == "size";
      std::string fallback(key.fallback);
      std::erase(fallback, '"');
      if (counted) {
        const auto range = toml::interval_of(key.range);
        REQUIRE(range.has_value());
        // Only a scene's clock may begin before zero.
        if (table.name != "run" || key.name != "at_s") CHECK(range->low >= 0);
        CHECK(range->low < range->high);
        if (const auto value = toml::bytes_in(fallback)) CHECK(range->holds(*value));
      }
      if (key.type == "choice") {
        const auto words = toml::words_of(key.range);
        if (fallback != "required") CHECK(std::count(words.begin(), words.end(), fallback) == 1);
      }
    }
  }
}

TEST_CASE("the example in the README is a valid cluster", "[runtime][config]") {
  const std::string text = readme();
  const size_t begin = text.find("```toml\n") + 8;
  const ClusterConfig cluster = good(text.substr(begin, text.find("```", begin) - begin));
  CHECK(cluster.nodes.size() == 5);
  CHECK(cluster.processes.size() == 5);
}

}  // namespace luxodus
