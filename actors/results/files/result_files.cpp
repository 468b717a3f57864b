#include "actors/results/files/result_files.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <span>

#include "actors/results/formats/false_colour_png.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/json_out.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// Endings of the files of each plane and of each camera.
constexpr std::array plane_endings{".csv", ".png", "_direct_clear_air.png"};
constexpr std::array view_endings{".exr", ".png", "_human.png", "_luminance.png"};
/// Files that every run writes; the last two only for some scenes.
constexpr std::array own_files{"flux.lux", "result.json", "patches.vtp", "volume.vti"};

/// The folder's result.json; null where there is none, or it is not a run's.
Json old_result(const fs::path& folder) {
  const auto bytes = read_whole_file(folder / "result.json", limits::max_result_bytes);
  if (!bytes) return nullptr;
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  Json result = Json::parse({text, bytes->size()});
  if (!result.is_object() || result.value("program", Json()) != "luxodus") return nullptr;
  return result;
}

/// Whether this is the name of a file directly in `folder`.
bool lies_in(const std::string& file, const std::string& folder) {
  if (!file.starts_with(folder + "/")) return false;
  const std::string name = file.substr(folder.size() + 1);
  return !name.empty() && name != "." && name != ".." &&
         name.find_first_of(std::string("/\0", 2)) == std::string::npos;
}

/// Adds the files of the planes or cameras that `list` names, in this folder. The names come from a
/// file: one that would lead out of the folder is skipped. Results older than the key "files" have
/// files named like the planes and cameras themselves.
void add_files(const Json& list, const std::string& folder, std::span<const char* const> endings,
               std::set<std::string>& files) {
  if (!list.is_array()) return;
  for (const Json& item : list) {
    if (!item.is_object() || !item.contains("name") || !item["name"].is_string()) continue;
    std::vector<std::string> of_item;
    if (item.contains("files") && item["files"].is_array()) {
      for (const Json& file : item["files"])
        if (file.is_string()) of_item.push_back(file);
    } else {
      for (const char* ending : endings)
        of_item.push_back(folder + "/" + item["name"].get<std::string>() + ending);
    }
    for (const std::string& file : of_item)
      if (lies_in(file, folder)) files.insert(file);
  }
}

/// Maps and pictures of a run, according to its result.
std::set<std::string> maps_of(const Json& result) {
  std::set<std::string> files{"patches.vtp", "volume.vti"};
  add_files(result.value("planes", Json()), "planes", plane_endings, files);
  add_files(result.value("cameras", Json()), "views", view_endings, files);
  return files;
}

/// By its first bytes: a killed run may have left a flux file without a result.json.
bool is_flux_file(const fs::path& file) {
  std::array<char, 7> begin{};
  std::ifstream in(file, std::ios::binary);
  return in.read(begin.data(), begin.size()) && std::string_view(begin.data(), 7) == "LUXFLUX";
}

template <class Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

}  // namespace

ResultNames result_names(const SceneDescription& scene) {
  return {file_names_of(names_of(scene.planes), plane_endings),
          file_names_of(names_of(scene.cameras), view_endings)};
}

bool is_drawn(const PlaneMeasure& p) {
  return p.cells_u <= limits::max_grid_edge && p.cells_v <= limits::max_grid_edge &&
         static_cast<uint64_t>(p.cells_u) * static_cast<uint64_t>(p.cells_v) <=
             limits::max_drawn_cells;
}

bool is_mapped(const Camera& camera) {
  return std::max(camera.width, camera.height) <= limits::max_grid_edge &&
         static_cast<uint64_t>(camera.width) * static_cast<uint64_t>(camera.height) <=
             limits::max_drawn_cells;
}

std::vector<std::string> files_of_plane(const SceneDescription& scene, size_t plane) {
  const std::string stem = "planes/" + result_names(scene).planes[plane];
  std::vector<std::string> files{stem + plane_endings[0]};
  if (is_drawn(scene.planes[plane]))
    files.insert(files.end(), {stem + plane_endings[1], stem + plane_endings[2]});
  return files;
}

std::vector<std::string> files_of_view(const SceneDescription& scene, size_t camera) {
  const std::string stem = "views/" + result_names(scene).views[camera];
  std::vector<std::string> files;
  for (const char* ending : view_endings) files.push_back(stem + ending);
  if (!is_mapped(scene.cameras[camera])) files.pop_back();
  return files;
}

OutputPlan run_output(const SceneDescription& scene, bool views) {
  OutputPlan plan{{own_files.begin(), own_files.end()}, {"planes", "preview", "preview/views"}};
  const auto add = [&](const std::vector<std::string>& files) {
    plan.files.insert(plan.files.end(), files.begin(), files.end());
  };
  for (size_t i = 0; i < scene.planes.size(); ++i) add(files_of_plane(scene, i));
  if (!views || scene.cameras.empty()) return plan;
  plan.folders.emplace_back("views");
  for (size_t i = 0; i < scene.cameras.size(); ++i) add(files_of_view(scene, i));
  return plan;
}

Result<void> remove_old_maps(const fs::path& folder) {
  const Json result = old_result(folder);
  if (result.is_null()) return {};
  std::error_code error;
  // If a subfolder were a symbolic link, files elsewhere would be removed.
  const auto is_own = [&](const std::string& file) {
    const fs::path parent = (folder / file).parent_path();
    return (parent == folder || fs::is_directory(fs::symlink_status(parent, error))) &&
           fs::is_regular_file(fs::symlink_status(folder / file, error));
  };
  for (const std::string& file : maps_of(result)) {
    if (!is_own(file)) continue;
    fs::remove(folder / file, error);
    if (error) {
      return system_problem(folder / file, "cannot remove this file of an earlier run",
                            error.value());
    }
  }
  // A folder with other files is not empty and stays.
  for (const char* name : {"planes", "views"}) {
    if (fs::is_directory(fs::symlink_status(folder / name, error)))
      fs::remove(folder / name, error);
  }
  return {};
}

Result<void> refuse_foreign_files(const fs::path& folder, const OutputPlan& plan) {
  const Json result = old_result(folder);
  std::set<std::string> own;
  if (!result.is_null()) {
    own = maps_of(result);
    own.insert("result.json");
  }
  if (is_flux_file(folder / "flux.lux")) own.insert("flux.lux");
  std::error_code error;
  for (const std::string& file : plan.files) {
    if (own.contains(file) || !fs::exists(fs::symlink_status(folder / file, error))) continue;
    return problem_in(folder / file,
                      "this file is there and no run has written it: move it away, give another "
                      "folder, or add --overwrite to luxodus run to replace it");
  }
  return {};
}

}  // namespace luxodus
