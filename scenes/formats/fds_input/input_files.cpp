#include "scenes/formats/fds_input/input_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/fds_input/fds_input.hpp"
#include "scenes/formats/fds_input/group_keys.hpp"

namespace luxodus::fds_input {

namespace {

namespace fs = std::filesystem;

const std::set<std::string_view>& wanted_groups() {
  static const std::set<std::string_view> names{
      "HEAD", "MISC", "MESH", "MULT", "SURF", "DEVC", "CTRL", "OBST", "HOLE", "VENT",
      "GEOM", "CATF", "TRNX", "TRNY", "TRNZ", "MOVE", "RAMP", "TIME", "TAIL"};
  return names;
}

/// Groups of chemistry, materials and outputs, which say nothing of a building.
bool is_beside_building(std::string_view name) {
  static const std::set<std::string_view> names{"SPEC", "REAC", "RAMP", "MATL", "PROP", "PART",
                                                "RADI", "COMB", "CLIP", "TABL", "HEAD", "TAIL",
                                                "DUMP", "SLCF", "BNDF", "ISOF", "PROF", "RADF"};
  return names.contains(name);
}

/// Whether a file somewhere else has only groups that say nothing of a building. Its content is
/// not told.
bool has_no_building(const fs::path& path) {
  const auto text = read_regular_file(path, luxodus::limits::fds_input_bytes);
  if (!text) return false;
  std::string_view rest = text.value();
  bool any = false;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.empty() || line.front() != '&') continue;
    line.remove_prefix(1);
    size_t length = 0;
    while (length < line.size() && line[length] >= 'A' && line[length] <= 'Z') ++length;
    if (!is_beside_building(line.substr(0, length))) return false;
    any = true;
  }
  return any;
}

Result<InputFile> one_file(const fs::path& file) {
  auto text = read_regular_file(file, luxodus::limits::fds_input_bytes);
  if (!text) return text.problem();
  InputFile out;
  out.name = file.string();
  out.text = std::make_unique<const std::string>(std::move(text).value());
  auto groups = read_namelists(*out.text, out.name, wanted_groups());
  if (!groups) return groups.problem();
  out.groups = std::move(groups).value();
  return out;
}

/// The path of a file in `folder` or below it, also after its links are followed.
std::optional<fs::path> inside(const fs::path& folder, const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == ".." ||
      name.find('\0') != std::string::npos)
    return std::nullopt;
  std::error_code failed;
  const fs::path root = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, failed);
  const fs::path real = fs::weakly_canonical(folder / path, failed);
  if (failed ||
      std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    return std::nullopt;
  return folder / path;
}

}  // namespace

Result<InputFiles> read_input_files(const fs::path& file) {
  InputFiles out;
  out.main = file.string();
  auto first = one_file(file);
  if (!first) return first.problem();
  out.files.push_back(std::move(first).value());
  std::optional<Problem> problem;
  std::vector<std::pair<std::string, int>> named;
  for (const Group& group : out.files.front().groups) {
    if (group.name != "CATF") continue;
    GroupKeys keys(group, out.main, problem);
    for (const std::string& name : keys.texts("OTHER_FILES"))
      named.emplace_back(name, keys.line_of("OTHER_FILES"));
  }
  if (problem) return *problem;
  if (named.size() > luxodus::limits::fds_input_files)
    return problem_in(
        out.main, named.front().second,
        fmt::format("&CATF names more than {} files", luxodus::limits::fds_input_files));
  uint64_t bytes = out.files.front().text->size();
  for (const auto& [name, line] : named) {
    const auto path = inside(file.parent_path(), name);
    if (!path && name.find('\0') == std::string::npos &&
        has_no_building(file.parent_path() / name)) {
      out.notes.push_back(
          fmt::format("line {}: the file \"{}\" of &CATF lies outside the folder and has "
                      "nothing of a building: it is passed over",
                      line, excerpt(name)));
      continue;
    }
    if (!path)
      return problem_in(out.main, line,
                        fmt::format("\"{}\" is no file in the folder of this input: &CATF is read "
                                    "from there alone",
                                    excerpt(name)));
    auto other = one_file(*path);
    if (!other) return other.problem();
    bytes += other->text->size();
    if (bytes > luxodus::limits::fds_input_bytes)
      return problem_in(out.main, line,
                        fmt::format("with this file the case has more than {} MB",
                                    luxodus::limits::fds_input_bytes >> 20));
    std::vector<Group>& groups = other->groups;
    const auto tail =
        std::find_if(groups.begin(), groups.end(), [](const Group& g) { return g.name == "TAIL"; });
    groups.erase(tail, groups.end());
    std::erase_if(groups, [](const Group& g) { return g.name == "HEAD"; });
    for (const Group& group : groups)
      if (group.name == "CATF")
        return problem_in(other->name, group.line,
                          "a file that &CATF names does not name others: FDS stops reading there");
    out.files.push_back(std::move(other).value());
  }
  return out;
}

}  // namespace luxodus::fds_input
