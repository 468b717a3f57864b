// `luxodus topology` as a user runs it: graphs made, saved, measured, compared, drawn, against
// closed forms; and messages about wrong files and options.
#include <nlohmann/json.hpp>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;
using Json = nlohmann::json;

namespace {

Json json_of(const TemporaryFolder& folder, const std::string& arguments) {
  const Outcome said = run_luxodus(folder, "topology " + arguments + " --json");
  INFO(said.err);
  REQUIRE(said.code == 0);
  return Json::parse(said.out);
}

std::string in(const TemporaryFolder& folder, const std::string& file) {
  return (folder / file).string();
}

/// The message of a refusal; it must exit with 2 and leave no file with this name.
std::string refusal(const TemporaryFolder& folder, const std::string& arguments,
                    const std::string& file = "none") {
  const Outcome said = run_luxodus(folder, "topology " + arguments);
  CHECK(said.code == 2);
  CHECK(said.out.empty());
  CHECK_FALSE(fs::exists(folder / file));
  return said.err;
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a minimum-path graph of 32 nodes and 4 links meets the lower bound",
          "[program][topology]") {
  const TemporaryFolder folder;
  const Json graph = json_of(folder, "amp --nodes 32 --links 4 -o " + in(folder, "a.toml"));
  CHECK(graph["links"] == 64);
  CHECK(graph["max_links"] == 4);
  // From each of 32 nodes: 4 at one hop, at most 12 at two, 15 left at three.
  CHECK(graph["all"]["paths"]["hops"] == 32 * (4 + 2 * 12 + 3 * 15));
  CHECK(graph["all"]["paths"]["hops"] == graph["all"]["bound"]["hops"]);
  CHECK(graph["all"]["paths"]["diameter"] == 3);
  const Json read = json_of(folder, "measure " + in(folder, "a.toml"));
  CHECK(read == graph);
}

TEST_CASE("a controller with links of its own is an additional vertex", "[program][topology]") {
  const TemporaryFolder folder;
  const Json graph = json_of(
      folder, "amp --nodes 12 --links 4 --controller 2 --seed 3 -o " + in(folder, "c.toml"));
  CHECK(graph["nodes"] == 12);
  CHECK(graph["controller"] == "endpoint");
  CHECK(graph["links"] == 12 * 4 / 2 + 1);  // it uses up two ends of links, and has two
  CHECK(json_of(folder, "measure " + in(folder, "c.toml")) == graph);
}

TEST_CASE("a search with the same seed finds the same graph", "[program][topology]") {
  const TemporaryFolder folder;
  const std::string search = "amp --nodes 14 --links 3 --search --seed 5 -o ";
  json_of(folder, search + in(folder, "one.toml"));
  json_of(folder, search + in(folder, "two.toml"));
  CHECK(slurp(folder / "one.toml") == slurp(folder / "two.toml"));
}

TEST_CASE("named graphs have the path lengths of their closed forms", "[program][topology]") {
  const TemporaryFolder folder;
  const auto average = [&](const std::string& kind) {
    return json_of(folder, "build " + kind)["all"]["paths"]["average"].get<double>();
  };
  CHECK(average("ring --nodes 8") == Approx(16.0 / 7));             // n^2 / 4 / (n - 1)
  CHECK(average("hypercube --nodes 32") == Approx(5 * 16.0 / 31));  // d 2^(d-1) / (2^d - 1)
  // A torus of 4 x 4: 2 hops a node on average over 16 nodes, one of which is the node itself.
  CHECK(average("torus --nodes 16") == Approx(32.0 / 15));
}

TEST_CASE(
    "in a comparison no graph with as many links has shorter paths than the minimum-path graph",
    "[program][topology]") {
  const TemporaryFolder folder;
  const Json compared = json_of(folder, "compare --nodes 32");
  REQUIRE(compared.size() == 8);
  const Json& best = compared.back();
  CHECK(best["graph"] == "minimum-path");
  for (const Json& one : compared) {
    INFO(one["graph"]);
    if (one["measures"]["links"] > best["measures"]["links"]) continue;
    CHECK(one["measures"]["all"]["paths"]["hops"] >= best["measures"]["all"]["paths"]["hops"]);
  }
  const Outcome text = run_luxodus(folder, "topology compare --nodes 9");
  CHECK(text.code == 0);
  CHECK(has(text.out, "9 is no power of two"));  // and the others are listed
  CHECK(has(text.out, "minimum-path"));
}

TEST_CASE("a drawing shows every node and every link once", "[program][topology]") {
  const TemporaryFolder folder;
  json_of(folder, "build ring --nodes 8 -o " + in(folder, "r.toml"));
  REQUIRE(
      run_luxodus(folder, "topology draw " + in(folder, "r.toml") + " -o " + in(folder, "r.dot"))
          .code == 0);
  const std::string dot = slurp(folder / "r.dot");
  size_t links = 0;
  for (size_t at = dot.find(" -- "); at != std::string::npos; at = dot.find(" -- ", at + 1))
    ++links;
  CHECK(links == 8);
  REQUIRE(
      run_luxodus(folder, "topology draw " + in(folder, "r.toml") + " -o " + in(folder, "r.svg"))
          .code == 0);
  const std::string svg = slurp(folder / "r.svg");
  CHECK(svg.starts_with("<svg "));
  CHECK(has(svg, "diameter 4"));
}

TEST_CASE("impossible graphs are rejected with the reason", "[program][topology]") {
  const TemporaryFolder folder;
  const std::string out = " -o " + in(folder, "none");
  CHECK(has(refusal(folder, "amp --nodes 32 --links 1" + out), "give each node more links"));
  CHECK(has(refusal(folder, "build hypercube --nodes 9" + out), "9 is no power of two"));
  CHECK(has(refusal(folder, "build cube --nodes 8" + out), "ring"));  // one of the kinds
  CHECK(has(refusal(folder, "amp --links 4" + out), "--nodes"));
  CHECK(has(refusal(folder, "amp --nodes 8 --seed -1" + out), "seed"));
}

TEST_CASE("a wrong graph file is rejected with its line", "[program][topology]") {
  const TemporaryFolder folder;
  json_of(folder, "build ring --nodes 8 -o " + in(folder, "r.toml"));
  const std::string good = slurp(folder / "r.toml");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    std::ofstream(folder / "w.toml") << text.replace(at, from.size(), to);
    return refusal(folder, "measure " + in(folder, "w.toml"));
  };
  CHECK(has(changed("[0, 1]", "[0, 99]"), "w.toml:7: there is no vertex 99"));
  CHECK(has(changed("[0, 1]", "[0, 3]"), "w.toml"));
  CHECK(has(changed("luxodus graph 1", "a graph"), "luxodus graph 1"));
  CHECK(has(refusal(folder, "measure " + in(folder, "missing.toml")), "missing.toml"));
  CHECK(has(
      refusal(folder, "draw " + in(folder, "r.toml") + " -o " + in(folder, "none.png"), "none.png"),
      "*.svg or *.dot"));
}
