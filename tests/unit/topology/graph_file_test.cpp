#include "topology/graph_file.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "runtime/core/random.hpp"
#include "tests/unit/topology/graph_tools.hpp"
#include "topology/builders.hpp"
#include "topology/shipped.hpp"

using namespace luxodus;

namespace {

std::string problem_of(const std::string& text) {
  const auto graph = parse_graph(text, "g.toml");
  return graph.ok() ? "" : graph.problem().text();
}

/// The text of a square graph, with one piece replaced.
std::string square_with(const std::string& piece, const std::string& replacement) {
  std::string text = graph_text(make_ring(4).value());
  const size_t at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

}  // namespace

TEST_CASE("a graph is read back from its text unchanged", "[topology][file]") {
  for (const ShippedSize& size : shipped_sizes()) {
    const Graph graph = *shipped_graph(size);
    const std::string text = graph_text(graph);
    const auto back = parse_graph(text, "g.toml");
    INFO(text);
    REQUIRE(back.ok());
    CHECK(back->hash() == graph.hash());
    CHECK(graph_text(back.value()) == text);
  }
  const auto lonely = parse_graph(graph_text(make_ring(1).value()), "one.toml");
  REQUIRE(lonely.ok());
  CHECK(lonely->vertices() == 1);
}

TEST_CASE("the graph in the README is valid", "[topology][file]") {
  std::ifstream in(LUX_SOURCE_DIR "/topology/README.md");
  std::ostringstream all;
  all << in.rdbuf();
  const std::string readme = all.str(), fence = "```toml\n";
  const size_t first = readme.find(fence) + fence.size();
  const auto graph =
      parse_graph(readme.substr(first, readme.find("```", first) - first), "README.md");
  REQUIRE(graph.ok());
  CHECK(graph->hash() == make_ring(4)->hash());
}

TEST_CASE("spacing and comments in a graph's text are free", "[topology][file]") {
  const std::string text =
      "# by hand\n\nformat=\"luxodus graph 1\"\r\n\tlinks = [\n[0,1] , # here\n[ 1,\n"
      "2 ]\n] # end\nnodes = 3\nrotation = 1\nmax_links = 2\ncontroller = \"none\"\n";
  const Graph expected = test::graph(3, 2, {{0, 1}, {1, 2}});
  const std::string hash_line = graph_text(expected).substr(graph_text(expected).find("hash"));
  CHECK(problem_of(text + hash_line).empty());
}

TEST_CASE("each mistake in a graph's text is reported with its line", "[topology][file]") {
  CHECK(problem_of("") == "g.toml:1: a graph begins with format = \"luxodus graph 1\"");
  CHECK(problem_of("nodes = 3\n") == "g.toml:1: a graph begins with format = \"luxodus graph 1\"");
  CHECK_THAT(problem_of(square_with("graph 1", "graph 2")),
             Catch::StartsWith("g.toml:1: this format"));
  CHECK_THAT(problem_of(square_with("rotation", "rotations")),
             Catch::StartsWith("g.toml:5: there is no key \"rotations\""));
  CHECK_THAT(problem_of(square_with("rotation", "nodes")),
             Catch::StartsWith("g.toml:5: \"nodes\" is given twice"));
  CHECK_THAT(problem_of(square_with("nodes = 4\n", "")), Catch::Contains("\"nodes\" is missing"));
  CHECK_THAT(problem_of(square_with("nodes = 4", "nodes = four")),
             Catch::StartsWith("g.toml:2: a whole number"));
  CHECK_THAT(problem_of(square_with("nodes = 4", "nodes = -4")), Catch::Contains("whole number"));
  CHECK_THAT(problem_of(square_with("nodes = 4", "nodes = 99999999999")),
             Catch::Contains("whole number"));
  CHECK_THAT(problem_of(square_with("nodes = 4\n", "nodes = 4 ")),
             Catch::StartsWith("g.toml:2: one key"));
  CHECK_THAT(problem_of(square_with("\"none\"", "\"some\"")),
             Catch::StartsWith("g.toml:4: the controller"));
  CHECK_THAT(problem_of(square_with("\"none\"", "\"none")), Catch::Contains("quotation mark"));
  CHECK_THAT(problem_of(square_with("[0, 1]", "[0, 9]")),
             Catch::StartsWith("g.toml:7: there is no vertex 9"));
  CHECK_THAT(problem_of(square_with("[0, 1]", "[0  1]")),
             Catch::StartsWith("g.toml:7: \",\" is missing"));
  CHECK_THAT(problem_of(square_with("[0, 1]", "[0, 2]")), Catch::Contains("more than 2 links"));
  CHECK_THAT(problem_of(square_with("hash = \"", "hash = \"0")),
             Catch::StartsWith("g.toml:9: the hash of this graph is"));
}

TEST_CASE("a file longer than any graph's is rejected before it is parsed", "[topology][file]") {
  CHECK_THAT(problem_of(std::string(limits::graph_file_bytes + 1, '#')), Catch::Contains("longer"));
}

TEST_CASE("a damaged text of a graph never ends the program or gives another graph",
          "[topology][file]") {
  const Graph graph = *shipped_graph({32, 4, 4});
  const std::string text = graph_text(graph);
  for (size_t length = 0; length + 1 < text.size(); ++length) {
    REQUIRE_FALSE(parse_graph(text.substr(0, length), "cut").ok());
  }
  Random random(11, RandomStream::test);
  random.start(0);
  for (int i = 0; i < 3000; ++i) {
    std::string scratched = text;
    scratched[random.bits() % text.size()] = static_cast<char>(random.bits());
    const auto read = parse_graph(scratched, "scratched");
    if (read.ok()) REQUIRE(read->hash() == graph.hash());
  }
}
