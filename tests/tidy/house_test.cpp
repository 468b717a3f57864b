// The rules of CONTRIBUTING.md that a machine can check, each as one test that names every file
// which breaks it. It reads the source tree only; it builds and runs nothing but `bash -n`.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path root = LUX_SOURCE_DIR;
constexpr const char* top_folders[] = {"runtime", "proto", "topology", "scenes", "actors", "tests"};
constexpr size_t max_columns = 100;
constexpr size_t max_lines = 700;

using Findings = std::vector<std::string>;

std::string joined(const Findings& findings) {
  std::string out;
  for (const auto& finding : findings) out += "\n  " + finding;
  return out;
}

#define CHECK_NONE(findings)   \
  do {                         \
    INFO(joined(findings));    \
    CHECK((findings).empty()); \
  } while (false)

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

struct Source {
  std::string path;  // from the repository's root, with '/'
  std::vector<std::string> lines;

  bool in(std::string_view folder) const { return path.rfind(std::string(folder) + "/", 0) == 0; }
  bool header() const { return path.ends_with(".hpp"); }
  std::string at(size_t line) const { return path + ":" + std::to_string(line + 1); }
};

/// Our files below a folder: not what npm has fetched or built.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  fs::recursive_directory_iterator at(folder);
  for (; at != fs::recursive_directory_iterator(); ++at) {
    const std::string name = at->path().filename().string();
    if (name == "node_modules" || name == "dist")
      at.disable_recursion_pending();
    else if (at->is_regular_file())
      files.push_back(at->path());
  }
  return files;
}

const std::vector<Source>& sources() {
  static const std::vector<Source> all = [] {
    std::vector<Source> found;
    for (const char* top : top_folders) {
      if (!fs::exists(root / top)) continue;
      for (const fs::path& file : files_below(root / top)) {
        const std::string suffix = file.extension().string();
        if (suffix == ".cpp" || suffix == ".hpp")
          found.push_back({fs::relative(file, root).generic_string(), lines_of(file)});
      }
    }
    std::sort(found.begin(), found.end(),
              [](const Source& a, const Source& b) { return a.path < b.path; });
    return found;
  }();
  return all;
}

/// The name between quotes or angle brackets of an include line; "" for other lines.
std::string included(const std::string& line, char open, char close) {
  std::string_view rest = line;
  const size_t start = rest.find_first_not_of(" \t");
  if (start == std::string_view::npos || rest[start] != '#') return {};
  rest.remove_prefix(start + 1);
  const size_t word = rest.find_first_not_of(" \t");
  if (word == std::string_view::npos || rest.substr(word, 7) != "include") return {};
  const size_t from = rest.find(open, word + 7);
  if (from == std::string_view::npos) return {};
  const size_t to = rest.find(close, from + 1);
  return to == std::string_view::npos ? std::string()
                                      : std::string(rest.substr(from + 1, to - from - 1));
}

bool starts_with_folder(const std::string& path, const std::string& folder) {
  return path.rfind(folder + "/", 0) == 0;
}

/// What each room may include besides itself and runtime/core, which every room may include.
const std::map<std::string, std::vector<std::string>> arrows{
    {"runtime/core", {}},
    {"proto", {}},
    {"topology", {}},
    {"runtime/fiber", {}},
    {"runtime/observe", {}},
    {"runtime/http", {}},
    {"runtime/storage", {}},
    {"runtime/toml", {}},
    {"runtime/actor", {"runtime/fiber", "runtime/observe"}},
    {"runtime/net", {"proto", "runtime/observe"}},
    {"runtime/config", {"runtime/net", "runtime/toml"}},
    {"runtime/fetch",
     {"proto", "runtime/actor", "runtime/fiber", "runtime/messaging", "runtime/net",
      "runtime/observe"}},
    {"runtime/messaging", {"proto", "runtime/actor", "runtime/net", "runtime/observe"}},
    {"runtime/sim", {"runtime/actor", "runtime/net", "runtime/storage"}},

    {"scenes/geometry", {}},
    {"scenes/tally", {}},
    {"scenes/optics", {"scenes/geometry"}},
    {"scenes/intersect", {"scenes/geometry"}},
    {"scenes/world", {"scenes/geometry", "scenes/optics"}},
    {"scenes/vision", {"scenes/optics"}},
    {"scenes/photometry", {"scenes/geometry", "scenes/optics"}},
    {"scenes/fields", {"scenes/geometry", "scenes/optics"}},
    {"scenes/dxf", {}},
    {"scenes/vdb", {"scenes/geometry"}},
    {"scenes/fds_input", {"scenes/fields", "scenes/geometry"}},
    {"scenes/ifc", {"scenes/geometry"}},
    {"scenes/images", {"scenes/optics", "scenes/world"}},
    {"scenes/emergency", {"scenes/world"}},
    {"scenes/scene_file",
     {"runtime/toml", "scenes/dxf", "scenes/emergency", "scenes/fields", "scenes/geometry",
      "scenes/images", "scenes/optics", "scenes/photometry", "scenes/world"}},
    {"scenes/transport",
     {"scenes/emergency", "scenes/geometry", "scenes/intersect", "scenes/optics", "scenes/tally",
      "scenes/world"}},
    {"scenes/pack", {"scenes/transport"}},

    {"actors/output", {"scenes"}},
    {"actors/run", {"actors/output", "scenes"}},
    {"actors/import",
     {"actors/output", "runtime/toml", "scenes/dxf", "scenes/fds_input", "scenes/fields",
      "scenes/geometry", "scenes/ifc", "scenes/photometry", "scenes/vdb"}},
    {"actors/inspect", {"actors/run", "scenes"}},
    {"actors/display", {"actors/inspect", "actors/output", "actors/run", "scenes"}},
    {"actors/assess", {"actors/inspect", "actors/output", "actors/run", "scenes"}},
    {"actors/report", {"actors/assess", "actors/output"}},
    {"actors/design",
     {"actors/assess", "actors/inspect", "actors/output", "actors/report", "actors/run", "scenes"}},
    {"actors/validate", {"actors/output", "actors/run", "scenes"}},
    {"actors/tally", {"runtime", "scenes/tally"}},
    {"actors/showing", {"actors/run", "actors/tally", "proto", "runtime"}},
    {"actors/source",
     {"actors/run", "actors/showing", "actors/tally", "runtime", "scenes/transport"}},
    {"actors/photon", {"actors/run", "actors/tally", "proto", "runtime", "scenes/transport"}},
    {"actors/objects", {"actors/output", "runtime", "scenes/transport"}},
    {"actors/supervise",
     {"actors/objects", "actors/output", "actors/photon", "actors/run", "actors/showing",
      "actors/source", "actors/tally", "runtime", "scenes", "topology"}},
    {"actors/simulate",
     {"actors/objects", "actors/run", "actors/showing", "actors/source", "actors/supervise",
      "runtime"}},
    {"actors/study",
     {"actors/objects", "actors/output", "actors/run", "actors/simulate", "actors/supervise",
      "actors/tally", "runtime", "scenes", "topology"}},
    {"actors/view",
     {"actors/assess", "actors/design", "actors/display", "actors/inspect", "actors/output",
      "actors/run", "runtime/http", "scenes"}},
    {"actors/python",
     {"actors/assess", "actors/display", "actors/inspect", "actors/output", "actors/run",
      "actors/supervise", "scenes"}},
    {"actors/cli", {"actors", "runtime", "scenes", "topology"}},
    {"tests", {"actors", "runtime", "proto", "topology", "scenes"}},
};

/// "scenes/optics" of "scenes/optics/medium.hpp": the longest name of a room that holds the file.
std::string room_of(const std::string& path) {
  const size_t second = path.find('/', path.find('/') + 1);
  const std::string inner = path.substr(0, second);
  return arrows.count(inner) > 0 ? inner : path.substr(0, path.find('/'));
}

bool allowed(const std::string& from, const std::string& to) {
  const auto room = arrows.find(room_of(from));
  if (room == arrows.end()) return false;
  const auto holds = [&](const std::string& folder) { return starts_with_folder(to, folder); };
  return holds(room->first) || holds("runtime/core") ||
         std::any_of(room->second.begin(), room->second.end(), holds);
}

/// Every room that a change of `room` may need: what it includes, and what that includes.
std::set<std::string> rooms_below(const std::string& room) {
  std::set<std::string> below;
  for (const auto& [other, unused] : arrows) {
    if (other == room || !allowed(room + "/x", other + "/x")) continue;
    below.insert(other);
    below.merge(rooms_below(other));
  }
  return below;
}

/// Characters, not bytes: UTF-8 continuation bytes do not count.
size_t columns_of(const std::string& line) {
  return static_cast<size_t>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

/// Every Markdown file of the tree.
std::vector<fs::path> markdown_files() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::vector<std::string> folders(std::begin(top_folders), std::end(top_folders));
  folders.push_back("docs");
  for (const std::string& folder : folders)
    for (const fs::path& file : files_below(root / folder))
      if (file.extension() == ".md") found.push_back(file);
  return found;
}

/// This file names what it forbids.
bool names_the_banned(const Source& source) {
  return source.in("tests/tidy");
}

}  // namespace

TEST_CASE("the tidy tests see the sources of the tree", "[tidy]") {
  CHECK(sources().size() > 5);
  CHECK(std::any_of(sources().begin(), sources().end(),
                    [](const Source& s) { return s.path == "runtime/core/result.hpp"; }));
}

TEST_CASE("the table of arrows says what the house says", "[tidy]") {
  CHECK(allowed("scenes/optics/a.hpp", "runtime/core/b.hpp"));
  CHECK(allowed("scenes/optics/a.hpp", "scenes/geometry/b.hpp"));
  CHECK(allowed("actors/cli/a.cpp", "scenes/scene_file/b.hpp"));
  CHECK(allowed("tests/unit/actors/a.cpp", "actors/source/b.hpp"));
  CHECK_FALSE(allowed("runtime/core/a.hpp", "scenes/optics/b.hpp"));
  CHECK_FALSE(allowed("runtime/core/a.hpp", "runtime/net/b.hpp"));
  CHECK_FALSE(allowed("runtime/actor/a.hpp", "runtime/net/b.hpp"));
  CHECK_FALSE(allowed("scenes/optics/a.hpp", "scenes/transport/b.hpp"));
  CHECK_FALSE(allowed("scenes/optics/a.hpp", "actors/source/b.hpp"));
  CHECK_FALSE(allowed("scenes/optics/a.hpp", "runtime/net/b.hpp"));
  CHECK_FALSE(allowed("actors/cli/a.cpp", "tests/tools/b.hpp"));
}

TEST_CASE("no room is below itself, and every folder of sources is a room", "[tidy]") {
  Findings bad;
  for (const auto& [room, unused] : arrows) {
    INFO(room);
    if (room == "tests" || room == "actors/cli") continue;  // nothing is above them
    CHECK(rooms_below(room).count(room) == 0);
  }
  for (const Source& source : sources())
    if (arrows.count(room_of(source.path)) == 0) bad.push_back(source.path + " is in no room");
  CHECK_NONE(bad);
}

TEST_CASE("scenes are pure, and a local run links no network", "[tidy]") {
  for (const char* room : {"scenes/pack", "scenes/scene_file", "actors/run", "actors/assess",
                           "actors/design", "actors/display", "actors/report", "actors/validate"}) {
    INFO(room);
    const std::set<std::string> below = rooms_below(room);
    for (const char* network :
         {"proto", "runtime/net", "runtime/http", "runtime/actor", "runtime/fiber"})
      CHECK(below.count(network) == 0);
  }
}

TEST_CASE("includes follow the arrows between rooms and name files from the root", "[tidy]") {
  Findings bad;
  for (const Source& source : sources())
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string name = included(source.lines[i], '"', '"');
      if (name.empty()) continue;
      if (!fs::is_regular_file(root / name))
        bad.push_back(source.at(i) + ": \"" + name + "\" is no file from the repository's root");
      else if (!allowed(source.path, name))
        bad.push_back(source.at(i) + ": this room may not include " + name);
    }
  CHECK_NONE(bad);
}

TEST_CASE("only the room of a library includes it", "[tidy]") {
  // Drawings are read where faces of signs are made, and drawn where results are written.
  const std::map<std::string, std::string> owner{
      {"embree", "scenes/intersect"},
      {"zmq", "runtime/net"},
      {"boost/context", "runtime/fiber"},
      {"boost/asio", "runtime/http"},
      {"boost/beast", "runtime/http"},
      {"librsvg", "scenes/emergency"},
      {"cairo", "scenes/emergency"},
      {"cereal", "scenes/pack"},
      {"dxflib", "actors/report"},
      {"zip.h", "scenes/photometry"},
      {"pugixml", "scenes/photometry"},
      {"openvdb", "scenes/vdb/program"},
      {"Cbc", "actors/design/mixed_integer_program.cpp"},
      {"Coin", "actors/design/mixed_integer_program.cpp"},
      {"Osi", "actors/design/mixed_integer_program.cpp"},
      {"nlopt", "actors/design/refine_layout.cpp"},
      {"CLI/", "actors/cli/options.cpp"},
      {"capnp", "proto"},
      {"kj", "proto"},
      {"toml++", "runtime/toml"},
      {"nlohmann", "actors/output/json.cpp"},
      {"pybind11", "actors/python"},
  };
  const auto is_excepted = [](const Source& source, const std::string& library) {
    const bool drawing = source.path == "actors/output/drawing.hpp" || source.in("tests");
    // A test reads back what is drawn, and is the server's other end.
    const bool other_end = source.in("tests") && (library == "dxflib" || library == "boost/asio" ||
                                                  library == "boost/beast");
    const bool tool = source.in("tests/tools") && library == "CLI/";
    // Tests read with it what we write; imported scenes are judged below `actors`.
    const bool json = library == "nlohmann" &&
                      (source.in("tests") || source.path == "scenes/geometry/mesh_text.cpp");
    const bool plan = library == "dxflib" && source.in("scenes/dxf");
    // Tests write the files that the program reads.
    const bool grids = library == "openvdb" && source.in("tests/unit/scenes/vdb");
    return other_end || tool || json || plan || grids ||
           (drawing && (library == "cairo" || library == "librsvg"));
  };
  Findings bad;
  for (const Source& source : sources())
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string name = included(source.lines[i], '<', '>');
      for (const auto& [library, room] : owner)
        if (name.rfind(library, 0) == 0 && source.path != room && !source.in(room) &&
            !is_excepted(source, library))
          bad.push_back(source.at(i) + ": <" + name + "> belongs to " + room);
    }
  CHECK_NONE(bad);
}

TEST_CASE("no line is wider than 100 columns, holds a tab, or ends in a blank", "[tidy]") {
  Findings bad;
  for (const Source& source : sources())
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string& line = source.lines[i];
      if (columns_of(line) > max_columns)
        bad.push_back(source.at(i) + ": " + std::to_string(columns_of(line)) + " columns");
      if (line.find('\t') != std::string::npos) bad.push_back(source.at(i) + ": a tab");
      if (!line.empty() && (line.back() == ' ' || line.back() == '\r'))
        bad.push_back(source.at(i) + ": ends in a blank or carriage return");
    }
  CHECK_NONE(bad);
}

TEST_CASE("no source is longer than 700 lines", "[tidy]") {
  Findings bad;
  for (const Source& source : sources())
    if (source.lines.size() > max_lines)
      bad.push_back(source.path + ": " + std::to_string(source.lines.size()) + " lines");
  CHECK_NONE(bad);
}

TEST_CASE("every header opens with what it promises and is included once", "[tidy]") {
  Findings bad;
  for (const Source& source : sources()) {
    if (!source.header()) continue;
    if (source.lines.empty() || source.lines[0].rfind("//", 0) != 0)
      bad.push_back(source.path + ": does not open with a comment");
    if (std::find(source.lines.begin(), source.lines.end(), "#pragma once") == source.lines.end())
      bad.push_back(source.path + ": has no #pragma once");
  }
  CHECK_NONE(bad);
}

TEST_CASE("no header opens a namespace to whoever includes it", "[tidy]") {
  Findings bad;
  for (const Source& source : sources()) {
    if (!source.header()) continue;
    for (size_t i = 0; i < source.lines.size(); ++i)
      if (source.lines[i].rfind("using namespace", 0) == 0) bad.push_back(source.at(i));
  }
  CHECK_NONE(bad);
}

TEST_CASE("chance comes from the counter-based generator and time from nowhere", "[tidy]") {
  struct Ban {
    std::string word;
    std::string within;  // "" for everywhere
    std::string reason;
    std::string but = {};  // a file that has to
  };
  const std::vector<Ban> bans{
      {"std::rand", "", "chance is keyed by seed, particle and draw"},
      {"random_device", "", "a run must be repeatable from its seed"},
      {"mt19937", "scenes", "chance is keyed by seed, particle and draw"},
      {"sleep_for", "", "nothing waits for the clock",
       "runtime/net/faulty_transport.cpp"},  // a node that stands still on purpose
      {"steady_clock::now", "scenes", "the physics knows no clock"},
      {"system_clock::now", "scenes", "the physics knows no clock"},
      {"std::cout", "scenes", "the physics prints nothing"},
      {"FIXME", "", "unfinished work is not committed"},
      {"TODO", "", "unfinished work is not committed"},
  };
  Findings bad;
  for (const Source& source : sources()) {
    if (names_the_banned(source)) continue;
    for (size_t i = 0; i < source.lines.size(); ++i)
      for (const Ban& ban : bans)
        if ((ban.within.empty() || source.in(ban.within)) && source.path != ban.but &&
            source.lines[i].find(ban.word) != std::string::npos)
          bad.push_back(source.at(i) + ": " + ban.word + ": " + ban.reason);
  }
  CHECK_NONE(bad);
}

TEST_CASE("no test's name holds what CMake would read as a list", "[tidy]") {
  // A bracket or a semicolon in one name makes CTest take many tests for one, which then runs none.
  Findings bad;
  for (const Source& source : sources()) {
    if (!source.in("tests")) continue;
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const size_t from = source.lines[i].find("TEST_CASE(\"");
      if (from == std::string::npos) continue;
      const size_t name = from + std::string_view("TEST_CASE(\"").size();
      const size_t to = source.lines[i].find('"', name);
      if (source.lines[i].substr(name, to - name).find_first_of("[];") != std::string::npos)
        bad.push_back(source.at(i));
    }
  }
  CHECK_NONE(bad);
}

TEST_CASE("every room with sources has a README.md, and tests have one for all", "[tidy]") {
  std::set<std::string> folders{"tests"};
  for (const Source& source : sources())
    if (!source.in("tests")) folders.insert(fs::path(source.path).parent_path().generic_string());
  Findings missing;
  for (const std::string& folder : folders) {
    const fs::path readme = root / folder / "README.md";
    std::error_code failed;
    if (!fs::exists(readme))
      missing.push_back(folder + "/README.md is missing");
    else if (fs::file_size(readme, failed) < 100)
      missing.push_back(folder + "/README.md says next to nothing");
  }
  CHECK_NONE(missing);
}

TEST_CASE("the documents that every repository has are there", "[tidy]") {
  Findings missing;
  for (const char* name : {"README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md",
                           "LICENSE", "CMakePresets.json", ".clang-format", ".clang-tidy",
                           ".ci/run", "run.sh", "test.sh", "setup.sh"})
    if (!fs::exists(root / name)) missing.push_back(name);
  CHECK_NONE(missing);
}

TEST_CASE("documents are at most 100 columns wide, tables, headings and addresses aside",
          "[tidy]") {
  const std::vector<fs::path> documents = markdown_files();
  CHECK(documents.size() > 100);
  Findings bad;
  for (const fs::path& document : documents) {
    const std::vector<std::string> lines = lines_of(document);
    bool code = false;
    for (size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].rfind("```", 0) == 0) code = !code;
      const bool table = lines[i].rfind('|', 0) == 0;
      const bool heading = !code && lines[i].rfind('#', 0) == 0;  // cannot go on in another line
      const bool address = lines[i].find("://") != std::string::npos;
      if (columns_of(lines[i]) > max_columns && !table && !heading && !address)
        bad.push_back(fs::relative(document, root).generic_string() + ":" + std::to_string(i + 1) +
                      ": " + std::to_string(columns_of(lines[i])) + " columns");
    }
  }
  CHECK_NONE(bad);
}

TEST_CASE("relative links in the documents lead somewhere", "[tidy]") {
  Findings bad;
  const std::vector<fs::path> documents = markdown_files();
  for (const fs::path& document : documents)
    for (const std::string& line : lines_of(document))
      for (size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 2)) {
        std::string target = line.substr(at + 2, line.find(')', at) - at - 2);
        target = target.substr(0, target.find('#'));
        if (target.empty() || target.find(':') != std::string::npos) continue;
        if (!fs::exists(document.parent_path() / target))
          bad.push_back(fs::relative(document, root).generic_string() + " links to " + target);
      }
  CHECK_NONE(bad);
}

TEST_CASE("every shell script parses and can be run", "[tidy]") {
  std::vector<fs::path> scripts{root / "setup.sh", root / "run.sh", root / "test.sh",
                                root / ".ci" / "run", root / ".ci" / "build"};
  for (const char* folder : {"actors/cli", "scripts", "scenes", "tests"}) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::path& file : files_below(root / folder))
      if (file.extension() == ".sh") scripts.push_back(file);
  }
  Findings bad;
  for (const fs::path& script : scripts) {
    const std::string name = fs::relative(script, root).generic_string();
    if (!fs::exists(script)) {
      bad.push_back(name + " is missing");
      continue;
    }
    if ((fs::status(script).permissions() & fs::perms::owner_exec) == fs::perms::none)
      bad.push_back(name + " is not executable");
    if (std::system(("bash -n '" + script.string() + "'").c_str()) != 0)
      bad.push_back(name + " does not parse");
  }
  CHECK_NONE(bad);
}
