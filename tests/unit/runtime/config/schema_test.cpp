// The README of cluster files says what the reader does: its tables are the schema's, its example
// reads.
#include "runtime/config/schema.hpp"

#include <fstream>
#include <sstream>

#include "runtime/config/table_reader.hpp"
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

TEST_CASE("the README ends with every table and key of the schema, in its words",
          "[runtime][config]") {
  const std::string text = readme();
  const size_t from = text.find("### ");
  REQUIRE(from != std::string::npos);
  std::istringstream said(text.substr(from)), meant(config::schema_markdown());
  for (std::string meant_line, said_line; std::getline(meant, meant_line);) {
    std::getline(said, said_line);
    REQUIRE(said_line == meant_line);
  }
  CHECK(said.peek() == EOF);
}

TEST_CASE("every type of the schema is explained, every default lies in its range",
          "[runtime][config]") {
  const std::string text = readme();
  const size_t from = text.find("## Every table and key");
  const std::string types = text.substr(from, text.find("### ") - from);
  for (const config::TableSpec& table : config::cluster_schema()) {
    CHECK_FALSE(table.keys.empty());
    for (const config::KeySpec& key : table.keys) {
      INFO(table.name << "." << key.name);
      CHECK(types.find(std::string(key.type)) != std::string::npos);
      CHECK_FALSE(key.meaning.empty());
      const bool counted = key.type == "integer" || key.type == "number" || key.type == "size";
      std::string fallback(key.fallback);
      std::erase(fallback, '"');
      if (counted) {
        const auto range = config::interval_of(key.range);
        REQUIRE(range.has_value());
        CHECK(range->low >= 0);
        CHECK(range->low < range->high);
        if (const auto value = config::bytes_of(fallback)) CHECK(range->holds(*value));
      }
      if (key.type == "choice") {
        const auto words = config::words_of(key.range);
        if (fallback != "required") CHECK(std::count(words.begin(), words.end(), fallback) == 1);
      }
    }
  }
}

TEST_CASE("the example of the README is a good cluster", "[runtime][config]") {
  const std::string text = readme();
  const size_t begin = text.find("```toml\n") + 8;
  const ClusterConfig cluster = good(text.substr(begin, text.find("```", begin) - begin));
  CHECK(cluster.nodes.size() == 5);
  CHECK(cluster.processes.size() == 5);
}

TEST_CASE("sizes are written as people write them", "[runtime][config]") {
  CHECK(config::bytes_of("4096") == 4096.0);
  CHECK(config::bytes_of("512 MiB") == 512.0 * 1024 * 1024);
  CHECK(config::bytes_of("1.5GB") == 1.5e9);
  for (const char* wrong : {"", "MiB", "1 XB", "1 MiB ", "1 2", "one"}) {
    INFO(wrong);
    CHECK_FALSE(config::bytes_of(wrong).has_value());
  }
}

TEST_CASE("the nearest word is what was meant, or nothing", "[runtime][config]") {
  const std::vector<std::string_view> known{"object_bytes", "tally_bytes", "fibers", "port"};
  CHECK(config::nearest_word("objects_bytes", known) == "object_bytes");
  CHECK(config::nearest_word("fibres", known) == "fibers");
  CHECK(config::nearest_word("prot", known) == "port");
  CHECK_FALSE(config::nearest_word("colour", known).has_value());
  CHECK_FALSE(config::nearest_word(std::string(100000, 'x'), known).has_value());
}

}  // namespace luxodus
