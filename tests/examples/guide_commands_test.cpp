// The guides as they are printed: their files are saved, their commands run in order, and what they
// show of the output is there. Where they say `build/release/luxodus`, they mean the program under
// test.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <utility>
#include <vector>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;

namespace {

const fs::path repository = LUX_SOURCE_DIR;

/// A fenced block, and the prose since the block before.
struct Block {
  std::string prose, kind, text;
};

std::vector<Block> blocks_of(const std::string& guide) {
  std::vector<Block> out;
  std::istringstream lines(slurp(repository / "docs/guide" / (guide + ".md")));
  Block block;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      if (inside) out.push_back(std::exchange(block, {}));
      if (!inside) block.kind = line.substr(3);
      inside = !inside;
    } else {
      (inside ? block.text : block.prose) += line + "\n";
    }
  }
  return out;
}

/// The file that the prose before a block says to save it as; "" if it says none.
std::string saved_as(const Block& block) {
  static const std::regex words("[Ss]ave\\s+this\\s+as\\s+`([^`]+)`");
  std::smatch found;
  return std::regex_search(block.prose, found, words) ? found[1].str() : "";
}

/// Examples of files, and of the output of other commands, begin otherwise or with "...".
bool is_output(const Block& block) {
  return block.kind == "text" && !block.text.starts_with("...");
}

/// Lines are broken to the width of the page.
std::string in_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

/// The first part of an example of output, between its "...", that a command has not printed after
/// the parts before it; "" if it has printed all.
std::string not_printed(const std::string& example, const std::string& printed) {
  const std::string shown = in_one_line(example), all = in_one_line(printed);
  size_t at = 0;
  for (size_t from = 0; from < shown.size();) {
    const size_t end = std::min(shown.find("...", from), shown.size());
    const size_t first = shown.find_first_not_of(' ', from);
    const size_t last = end == 0 ? end : shown.find_last_not_of(' ', end - 1);
    if (first < end) {
      const std::string part = shown.substr(first, last + 1 - first);
      at = all.find(part, at);
      if (at == std::string::npos) return part;
    }
    from = end + 3;
  }
  return "";
}

/// A browser, which PDF files need, is not among the packages of the tests.
std::string without_pdf(const std::string& commands) {
  return std::regex_replace(commands, std::regex(" --pdf"), "");
}

/// Follows a guide until its commands have been run `count` times.
void follow(const std::string& guide, size_t count) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "build/release");
  fs::create_symlink(LUX_PROGRAM, folder / "build/release/luxodus");
  fs::create_directory_symlink(repository / "scenes", folder / "scenes");
  std::string printed;
  for (const Block& block : blocks_of(guide)) {
    if (const std::string file = saved_as(block); !file.empty()) {
      fs::create_directories((folder / file).parent_path());
      std::ofstream(folder / file) << block.text;
    } else if (block.kind == "sh") {
      if (count-- == 0) return;
      std::ofstream(folder / "commands.sh") << "set -e\n" << without_pdf(block.text);
      const Outcome ran =
          shell(folder, "cd " + (folder / "").string() + " && bash commands.sh");
      INFO(block.text << ran.out << ran.err);
      CHECK(ran.code == 0);
      printed = ran.out + ran.err;
    } else if (is_output(block) && !printed.empty()) {
      INFO("the program printed:\n" << printed);
      CHECK(not_printed(block.text, printed) == "");
    }
  }
}

}  // namespace

TEST_CASE("the guide to a first scene works as printed", "[program][guide]") {
  follow("first-scene", 1);
}

TEST_CASE("the guide to a first assessment works as printed", "[program][guide]") {
  follow("first-assessment", 5);
}

TEST_CASE("the guide to a project by EN 1838 works as printed", "[program][guide]") {
  follow("en1838-project", 3);
}

TEST_CASE("the guide to a project by EN 1838 works as printed to its end",
          "[program][guide][long]") {
  follow("en1838-project", 6);
}
