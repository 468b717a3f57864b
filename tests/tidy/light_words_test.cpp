// The runtime is a library of other programs as well: what it holds names nothing of light. It
// reads the source tree only.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path tree = LUX_SOURCE_DIR;

/// The words of a line, in lower case: parts of identifiers are words.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words(1);
  for (size_t i = 0; i < line.size(); ++i) {
    const auto c = static_cast<unsigned char>(line[i]);
    const bool begins =
        std::isupper(c) != 0 && i > 0 && std::islower(static_cast<unsigned char>(line[i - 1])) != 0;
    if ((std::isalpha(c) == 0 || begins) && !words.back().empty()) words.emplace_back();
    if (std::isalpha(c) != 0) words.back() += static_cast<char>(std::tolower(c));
  }
  return words;
}

/// What of the runtime speaks of light, and why.
struct SpeaksOfLight {
  const char* path;  // a file, or all that begin so
  const char* reason;
};
constexpr SpeaksOfLight speaks_of_light[] = {
    {"proto/messages.hpp", "one union numbers the messages of all: those of a run are among them"},
    {"proto/wire.capnp", "as messages.hpp"},
    {"proto/field_list.hpp", "its example is a message of a run"},
    {"proto/codec", "memory of lists of leases is reused"},
    {"runtime/config/", "the cluster file of a run"},
    {"runtime/core/random.", "draws are keyed by particle, and streams named by their use"},
    {"runtime/core/wide.hpp", "who sums in it"},
    {"runtime/core/buggify.hpp", "rare paths of a run are drawn with the runtime's"},
    {"runtime/messaging/actor_system.", "memory of lists of leases is reused"},
    {"runtime/net/network.hpp", "memory of lists of leases is reused"},
    {"runtime/net/handshake.cpp", "the reasons of a refusal are on the wire"},
    {"runtime/net/counters.hpp", "the reasons of a refusal are on the wire"},
    {"runtime/observe/node_trace.hpp", "the kinds of spans in a run's trace"},
    {"runtime/observe/trace_ring.", "the kinds of spans in a run's trace"},
    {"runtime/storage/journal.cpp", "a sentence of the manual"},
};

}  // namespace

TEST_CASE("the runtime, the protocol and the topology name nothing of light", "[tidy]") {
  const std::set<std::string> light{
      "photon",    "photons",   "luminaire", "luminaires", "lamp",    "lamps", "illuminance",
      "luminance", "scene",     "scenes",    "tally",      "tallies", "smoke", "flux",
      "particle",  "particles", "embree",    "lease",      "leases"};
  std::set<std::string> used;
  std::vector<std::string> bad;
  const auto check = [&](const std::string& path, std::istream& in) {
    size_t number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      for (const std::string& word : words_of(line)) {
        if (light.count(word) == 0) continue;
        const auto excepted =
            std::find_if(std::begin(speaks_of_light), std::end(speaks_of_light),
                         [&](const SpeaksOfLight& one) { return path.rfind(one.path, 0) == 0; });
        if (excepted != std::end(speaks_of_light))
          used.insert(excepted->path);
        else
          bad.push_back(path + ":" + std::to_string(number) + ": " + word);
      }
    }
  };
  size_t files = 0;
  for (const char* folder : {"runtime", "proto", "topology"})
    for (const auto& entry : fs::recursive_directory_iterator(tree / folder)) {
      const std::string kind = entry.path().extension().string();
      if (kind != ".hpp" && kind != ".cpp" && kind != ".capnp") continue;
      std::ifstream in(entry.path());
      check(fs::relative(entry.path(), tree).generic_string(), in);
      ++files;
    }
  CHECK(files > 150);
  for (const SpeaksOfLight& one : speaks_of_light)
    if (used.count(one.path) == 0)
      bad.push_back(std::string(one.path) + " is excepted, and names nothing of light");
  std::string all;
  for (const std::string& one : bad) all += "\n  " + one;
  INFO(all);
  CHECK(bad.empty());
}
