// The rules of CONTRIBUTING.md that a machine can check, each as one test that names every file
// which breaks it. It reads the source tree only; it builds and runs nothing but `bash -n`.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
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

/// Shell scripts, whether they are there or not.
std::vector<fs::path> scripts() {
  std::vector<fs::path> out{root / "setup.sh", root / "run.sh", root / "test.sh",
                            root / ".ci" / "run", root / ".ci" / "build"};
  for (const char* folder : {"actors", "scenes", "tests", "findings"}) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::path& file : files_below(root / folder))
      if (file.extension() == ".sh") out.push_back(file);
  }
  return out;
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

/// A row of a table in docs/architecture/rooms.md: its cells, without backticks.
using Row = std::vector<std::string>;

std::vector<std::string> split(const std::string& text, const std::string& at) {
  std::vector<std::string> parts;
  size_t from = 0;
  for (size_t to = text.find(at); to != std::string::npos; to = text.find(at, from)) {
    parts.push_back(text.substr(from, to - from));
    from = to + at.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

std::string trimmed(const std::string& text) {
  const size_t from = text.find_first_not_of(' ');
  if (from == std::string::npos) return {};
  return text.substr(from, text.find_last_not_of(' ') - from + 1);
}

/// The members of a cell: "a, b" has two, "" none.
std::vector<std::string> members_of(const std::string& cell) {
  return cell.empty() ? std::vector<std::string>{} : split(cell, ", ");
}

/// Rows of all tables of the page that have so many cells, without their headings.
std::vector<Row> rooms_page_rows(size_t cells) {
  std::vector<Row> rows;
  for (const std::string& line : lines_of(root / "docs/architecture/rooms.md")) {
    Row row = split(line, "|");
    if (row.size() != cells + 2 || line.rfind("|", 0) != 0 || line.rfind("|--", 0) == 0) continue;
    row = Row(row.begin() + 1, row.end() - 1);
    for (std::string& cell : row) {
      cell.erase(std::remove(cell.begin(), cell.end(), '`'), cell.end());
      cell = trimmed(cell);
    }
    if (row[0] != "room" && row[0] != "library") rows.push_back(row);
  }
  return rows;
}

struct Room {
  std::vector<std::string> includes, libraries;
};

/// The rooms of docs/architecture/rooms.md, and the tests, which may include everything.
const std::map<std::string, Room>& rooms() {
  static const std::map<std::string, Room> all = [] {
    std::map<std::string, Room> found;
    for (const Row& row : rooms_page_rows(5))
      found[row[0]] = {members_of(row[2]), members_of(row[3])};
    found["tests"] = {{"actors", "runtime", "proto", "topology", "scenes"}, {}};
    return found;
  }();
  return all;
}

/// A library from outside: how names of its headers begin, and the files that alone include it.
struct Library {
  std::string name;
  std::vector<std::string> headers, files;
};

std::vector<Library> libraries() {
  std::vector<Library> found;
  for (const Row& row : rooms_page_rows(4))
    found.push_back({row[0], members_of(row[2]), members_of(row[3])});
  return found;
}

/// "scenes/light/optics" of "scenes/light/optics/medium.hpp": the longest name of a room that holds
/// the file; "" if none does.
std::string room_of(const std::string& path) {
  std::string longest;
  for (const auto& [room, unused] : rooms())
    if (starts_with_folder(path, room) && room.size() > longest.size()) longest = room;
  return longest;
}

bool allowed(const std::string& from, const std::string& to) {
  const auto room = rooms().find(room_of(from));
  if (room == rooms().end()) return false;
  const auto holds = [&](const std::string& folder) { return starts_with_folder(to, folder); };
  return holds(room->first) || holds("runtime/core") ||
         std::any_of(room->second.includes.begin(), room->second.includes.end(), holds);
}

/// Every room that a change of `room` may need: what it includes, and what that includes.
std::set<std::string> rooms_below(const std::string& room) {
  std::set<std::string> below;
  std::vector<std::string> open{room};
  while (!open.empty()) {
    const std::string from = open.back();
    open.pop_back();
    for (const auto& [other, unused] : rooms())
      if (other != from && allowed(from + "/x", other + "/x") && below.insert(other).second)
        open.push_back(other);
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

/// Whether a file exists, or one of its folder whose name begins as `file` does up to its '*'.
bool is_there(const fs::path& file) {
  const std::string name = file.filename().string();
  const size_t star = name.find('*');
  if (star == std::string::npos) return fs::exists(file);
  for (const auto& entry : fs::directory_iterator(file.parent_path()))
    if (entry.path().filename().string().rfind(name.substr(0, star), 0) == 0) return true;
  return false;
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

TEST_CASE("the page of rooms says what the house says", "[tidy]") {
  CHECK(allowed("scenes/light/optics/a.hpp", "runtime/core/b.hpp"));
  CHECK(allowed("scenes/light/optics/a.hpp", "scenes/light/geometry/b.hpp"));
  CHECK(allowed("actors/apps/cli/a.cpp", "scenes/formats/scene_file/b.hpp"));
  CHECK(allowed("tests/unit/actors/a.cpp", "actors/cast/coordinator/b.hpp"));
  CHECK_FALSE(allowed("runtime/core/a.hpp", "scenes/light/optics/b.hpp"));
  CHECK_FALSE(allowed("runtime/core/a.hpp", "runtime/net/b.hpp"));
  CHECK_FALSE(allowed("runtime/actor/a.hpp", "runtime/net/b.hpp"));
  CHECK_FALSE(allowed("scenes/light/optics/a.hpp", "scenes/light/transport/b.hpp"));
  CHECK_FALSE(allowed("scenes/light/optics/a.hpp", "actors/cast/coordinator/b.hpp"));
  CHECK_FALSE(allowed("scenes/light/optics/a.hpp", "runtime/net/b.hpp"));
  CHECK_FALSE(allowed("actors/apps/cli/a.cpp", "tests/tools/b.hpp"));
}

TEST_CASE("no room is below itself, and every folder of sources is a room", "[tidy]") {
  Findings bad;
  for (const auto& [room, unused] : rooms()) {
    INFO(room);
    if (room != "tests") CHECK(fs::is_directory(root / room));
    CHECK(rooms_below(room).count(room) == 0);
  }
  for (const Source& source : sources())
    if (room_of(source.path).empty()) bad.push_back(source.path + " is in no room");
  CHECK_NONE(bad);
}

TEST_CASE("groups of rooms are below each other in one direction", "[tidy]") {
  // What the light needs is no file format; what a run leaves is judged, and not the reverse.
  const auto is_below = [](const std::string& lower, const std::string& upper) {
    Findings bad;
    for (const auto& [room, unused] : rooms())
      if (starts_with_folder(room, lower))
        for (const std::string& below : rooms_below(room))
          if (starts_with_folder(below, upper)) bad.push_back(room + " needs " + below);
    return bad;
  };
  CHECK_NONE(is_below("runtime", "scenes"));
  CHECK_NONE(is_below("scenes/light", "scenes/formats"));
  CHECK_NONE(is_below("scenes", "actors"));
  CHECK_NONE(is_below("actors/results", "actors/judge"));
  CHECK_NONE(is_below("actors/results", "actors/cast"));
  CHECK_NONE(is_below("actors/judge", "actors/cast"));
  for (const char* group : {"actors/cast", "actors/results", "actors/judge"}) {
    INFO(group);
    CHECK_NONE(is_below(group, "actors/apps"));
    CHECK_NONE(is_below(group, "actors/lab"));
  }
}

TEST_CASE("scenes are pure, and a local run links no network", "[tidy]") {
  for (const auto& [room, unused] : rooms()) {
    const bool local = starts_with_folder(room, "scenes") ||
                       starts_with_folder(room, "actors/results") ||
                       starts_with_folder(room, "actors/judge");
    if (!local) continue;
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

TEST_CASE("every room that another lists is included by it", "[tidy]") {
  std::set<std::pair<std::string, std::string>> included_rooms;
  for (const Source& source : sources()) {
    const auto room = rooms().find(room_of(source.path));
    if (room == rooms().end()) continue;
    for (const std::string& line : source.lines) {
      const std::string name = included(line, '"', '"');
      for (const std::string& listed : room->second.includes)
        if (starts_with_folder(name, listed)) included_rooms.insert({room->first, listed});
    }
  }
  Findings bad;
  for (const auto& [name, room] : rooms())
    for (const std::string& listed : room.includes)
      if (included_rooms.count({name, listed}) == 0)
        bad.push_back(name + " lists " + listed + ", and includes nothing of it");
  CHECK_NONE(bad);
}

TEST_CASE("only the rooms that list a library include it", "[tidy]") {
  const auto is_excepted = [](const Source& source, const std::string& library) {
    // A test reads back what is drawn and written, and is the server's other end.
    static const std::set<std::string> read_back{
        "Boost.Asio",    "cairo",   "dxflib", "HDF5",   "libpng", "librsvg",
        "nlohmann-json", "OpenEXR", "spdlog", "SQLite", "zstd"};
    return (source.in("tests") && read_back.count(library) > 0) ||
           (source.in("tests/tools") && library == "CLI11") ||
           (source.in("tests/unit/runtime/net") && library == "ZeroMQ") ||
           (source.in("tests/bench/peers") && library == "ZeroMQ");
  };
  Findings bad;
  for (const Source& source : sources()) {
    const Room& room = rooms().at(room_of(source.path));
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string name = included(source.lines[i], '<', '>');
      if (name.empty()) continue;
      for (const Library& library : libraries()) {
        const auto begins = [&](const std::string& header) { return name.rfind(header, 0) == 0; };
        const auto holds = [&](const std::string& file) { return source.path == file; };
        if (std::none_of(library.headers.begin(), library.headers.end(), begins)) continue;
        const bool listed =
            std::count(room.libraries.begin(), room.libraries.end(), library.name) > 0;
        const bool elsewhere = !library.files.empty() &&
                               std::none_of(library.files.begin(), library.files.end(), holds);
        if ((!listed || elsewhere) && !is_excepted(source, library.name))
          bad.push_back(source.at(i) + ": <" + name + "> belongs to the rooms that list " +
                        library.name);
      }
      // Which takes half a minute to compile: a program of its own reads its files, tests write
      // them.
      if (name.rfind("openvdb", 0) == 0 && !source.in("scenes/formats/vdb/program") &&
          !source.in("tests/unit/scenes/formats/vdb") && !source.in("tests/tools"))
        bad.push_back(source.at(i) + ": <" + name + "> belongs to scenes/formats/vdb/program");
    }
  }
  CHECK_NONE(bad);
}

TEST_CASE("no line is wider than 100 columns, holds a tab, or ends in a blank", "[tidy]") {
  Findings bad;
  std::vector<Source> read = sources();
  for (const fs::path& script : scripts())
    read.push_back({fs::relative(script, root).generic_string(), lines_of(script)});
  for (const Source& source : read)
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

namespace {

/// The name of a type that a line defines at the level of a namespace, "" if none.
std::string defined_type(const std::string& line) {
  for (const std::string_view kind : {"struct ", "class ", "enum class "}) {
    if (line.rfind(kind, 0) != 0 || line.ends_with(";")) continue;
    const size_t end = line.find_first_not_of(
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", kind.size());
    // "Outer::Inner" is nested, and "Form<int>" a specialisation.
    return end < line.size() && line[end] == ' ' ? line.substr(kind.size(), end - kind.size()) : "";
  }
  return "";
}

}  // namespace

// Two types of one name in one namespace are one for the linker, which keeps the functions of
// either.
TEST_CASE("no two headers define types of one name in one namespace", "[tidy]") {
  std::map<std::string, std::string> places;
  Findings bad;
  for (const Source& source : sources()) {
    if (!source.header() || source.in("tests")) continue;
    std::vector<std::string> spaces;
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string& line = source.lines[i];
      if (line.rfind("namespace ", 0) == 0 && line.ends_with("{")) spaces.push_back(line);
      if (line.rfind("}  // namespace", 0) == 0 && !spaces.empty()) spaces.pop_back();
      const std::string type = defined_type(line);
      if (type.empty()) continue;
      std::string name;
      for (const std::string& space : spaces) name += space;
      const auto [first, is_new] = places.emplace(name + type, source.at(i));
      if (!is_new) bad.push_back(source.at(i) + ": " + type + ", as in " + first->second);
    }
  }
  CHECK(places.size() > 500);
  CHECK_NONE(bad);
}

TEST_CASE("chance comes from the counter-based generator and time from nowhere", "[tidy]") {
  struct Ban {
    std::string word;
    std::string within;  // "" for everywhere
    std::string reason;
    std::set<std::string> but = {};  // files that have to
  };
  const std::vector<Ban> bans{
      {"std::rand", "", "chance is keyed by seed, particle and draw"},
      {"random_device", "", "a run must be repeatable from its seed"},
      {"mt19937", "scenes", "chance is keyed by seed, particle and draw"},
      {"sleep_for",
       "",
       "nothing waits for the clock",
       {"runtime/net/faulty_transport.cpp",   // a node that stands still on purpose
        "tests/bench/peers/processes.cpp"}},  // a while in which others work, to be measured
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
        if ((ban.within.empty() || source.in(ban.within)) && ban.but.count(source.path) == 0 &&
            source.lines[i].find(ban.word) != std::string::npos)
          bad.push_back(source.at(i) + ": " + ban.word + ": " + ban.reason);
  }
  CHECK_NONE(bad);
}

TEST_CASE("what a function gives where it may fail is a Result", "[tidy]") {
  // With an optional problem, "none" means success, the opposite of every other test. A reference
  // to one that is kept (the fault of a node) is data.
  constexpr std::string_view kind = "std::optional<Problem>";
  const auto is_letter = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':';
  };
  Findings bad;
  for (const Source& source : sources()) {
    if (names_the_banned(source)) continue;
    for (size_t i = 0; i < source.lines.size(); ++i) {
      const std::string& line = source.lines[i];
      for (size_t at = line.find(kind); at != std::string::npos; at = line.find(kind, at + 1)) {
        std::string_view rest = std::string_view(line).substr(at + kind.size());
        const bool before_body = rest.starts_with(" {");
        while (rest.starts_with(" ")) rest.remove_prefix(1);
        while (!rest.empty() && is_letter(rest.front())) rest.remove_prefix(1);
        if (before_body || rest.starts_with("(")) bad.push_back(source.at(i) + ": " + line);
      }
    }
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
  for (const fs::path& document : documents) {
    bool code = false;  // where "[&](Mail& mail)" is no link
    for (const std::string& line : lines_of(document)) {
      if (line.rfind("```", 0) == 0) code = !code;
      for (size_t at = line.find("]("); at != std::string::npos && !code;
           at = line.find("](", at + 2)) {
        std::string target = line.substr(at + 2, line.find(')', at) - at - 2);
        target = target.substr(0, target.find('#'));
        if (target.empty() || target.find(':') != std::string::npos) continue;
        if (!fs::exists(document.parent_path() / target))
          bad.push_back(fs::relative(document, root).generic_string() + " links to " + target);
      }
    }
  }
  CHECK_NONE(bad);
}

TEST_CASE("every file and name in the table of what is where exists", "[tidy]") {
  // A cell names files from the root, or the file before and another ending or file of its folder:
  // "`a/b.cpp` (`f`), `c.cpp` (`g`)"; names in brackets stand in the file before them.
  Findings bad;
  bool in_table = false;
  for (const std::string& line : lines_of(root / "docs/architecture/overview.md")) {
    if (line.rfind("## ", 0) == 0) in_table = line == "## Where is what";
    if (!in_table || line.rfind("| ", 0) != 0) continue;
    const std::vector<std::string> cells = split(line, " | ");
    if (cells.size() < 2) continue;
    fs::path file;
    bool in_brackets = false;
    const std::vector<std::string> parts = split(cells[1], "`");
    for (size_t i = 0; i < parts.size(); ++i) {
      if (i % 2 == 0) {
        if (parts[i].find('(') != std::string::npos) in_brackets = true;
        if (parts[i].find(')') != std::string::npos) in_brackets = parts[i].back() == '(';
        continue;
      }
      if (in_brackets) {
        std::ifstream in(file);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        if (text.find(parts[i]) == std::string::npos)
          bad.push_back(parts[i] + " is not in " + fs::relative(file, root).generic_string());
        continue;
      }
      if (parts[i].rfind('.', 0) == 0)
        file.replace_extension(parts[i]);
      else
        file = parts[i].find('/') == std::string::npos ? file.parent_path() / parts[i]
                                                       : root / parts[i];
      if (!is_there(file)) bad.push_back(fs::relative(file, root).generic_string() + " is no file");
    }
  }
  CHECK_NONE(bad);
}

TEST_CASE("every shell script parses and can be run", "[tidy]") {
  Findings bad;
  for (const fs::path& script : scripts()) {
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
