#include "actors/display/result_files.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

#include "scenes/format/json_out.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// The endings of what is written of each plane and of each camera.
constexpr std::array plane_endings{".csv", ".png", "_direct_clear_air.png"};
constexpr std::array view_endings{".exr", ".png", "_human.png", "_luminance.png"};

/// The folder's result.json; null where there is none, or none of ours.
Json old_result(const fs::path& folder) {
  const auto bytes = read_whole_file(folder / "result.json", limits::result_bytes_most);
  if (!bytes.ok()) return nullptr;
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  Json result = Json::parse(text, text + bytes->size(), nullptr, false);
  if (!result.is_object() || result.value("program", Json()) != "luxodus") return nullptr;
  return result;
}

/// Adds the files of the planes or cameras that `list` names, in this folder. The names come from a
/// file: one that would lead out of the folder is passed over.
void add_files(const Json& list, const fs::path& folder, std::span<const char* const> endings,
               std::vector<fs::path>& files) {
  if (!list.is_array()) return;
  for (const Json& item : list) {
    if (!item.is_object() || !item.contains("name") || !item["name"].is_string()) continue;
    const auto name = item["name"].get<std::string>();
    if (name.find_first_of(std::string("/\0", 2)) != std::string::npos) continue;
    for (const char* ending : endings) files.push_back(folder / (name + ending));
  }
}

}  // namespace

Result<Done> remove_old_maps(const fs::path& folder) {
  const Json result = old_result(folder);
  if (result.is_null()) return Done{};
  std::vector<fs::path> files{folder / "patches.vtp", folder / "volume.vti"};
  add_files(result.value("planes", Json()), folder / "planes", plane_endings, files);
  add_files(result.value("cameras", Json()), folder / "views", view_endings, files);
  std::error_code error;
  for (const fs::path& file : files) {
    if (!fs::is_regular_file(fs::symlink_status(file, error))) continue;
    fs::remove(file, error);
    if (error) {
      return Problem{{file.string(), 0},
                     "cannot remove this file of an earlier run: " + error.message()};
    }
  }
  // A folder that holds something else is not empty and stays.
  for (const char* name : {"planes", "views"}) {
    if (fs::is_directory(fs::symlink_status(folder / name, error)))
      fs::remove(folder / name, error);
  }
  return Done{};
}

}  // namespace luxodus
