#include "actors/apps/cli/finished_run.hpp"

#include "actors/apps/cli/load_scene.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

bool has_text(const Json& object, const char* key) {
  return object.is_object() && object.contains(key) && object[key].is_string();
}

/// Time for all particles; nothing if a part of them was traced in an unrecorded time.
std::optional<double> seconds_in(const Json& result) {
  const Json seconds = result.value("seconds", Json());
  if (!seconds.is_object() || !seconds.value("value", Json()).is_number()) return std::nullopt;
  if (result.value("timed_particles", Json()) != result.value("particles", Json()))
    return std::nullopt;
  return seconds["value"].get<double>();
}

}  // namespace

Result<Json> read_json_file(const fs::path& file) {
  constexpr uint64_t max_bytes = uint64_t{1} << 30;
  auto bytes = read_whole_file(file, max_bytes);
  if (!bytes) return bytes.problem();
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  return Json::parse({text, bytes->size()});
}

Result<FinishedRun> read_finished_run(const fs::path& folder) {
  const fs::path file = folder / "result.json";
  std::error_code failed, ignored;
  const bool there = fs::exists(file, failed);
  if (failed) return system_problem(file, "this file cannot be read", failed.value());
  if (!there) {
    const bool assessed = fs::exists(folder / "assessment.json", ignored);
    return problem_in(
        folder, assessed ? "this is the folder of an assessment, not of a run: give the folder "
                           "that luxodus run has written"
                         : "there is no result.json here: give the folder that luxodus run has "
                           "written");
  }
  const auto read = read_json_file(file);
  if (!read) return read.problem();
  const Json& json = read.value();
  if (!has_text(json, "scene_file") || !has_text(json, "scenario") ||
      !json.value("seed", Json()).is_number_unsigned() ||
      !json.value("cells", Json()).is_number_integer()) {
    return problem_in(file, "this is no result of a run: run the scene again");
  }
  FinishedRun out{
      json["scene_file"], json["scenario"], json["seed"], json["cells"], {}, {}, 0, {}, {}};
  if (json.value("batches", Json()).is_number_integer()) out.batches = json["batches"];
  out.seconds = seconds_in(json);
  if (json.value("at_s", Json()).is_number()) out.at_s = json["at_s"];
  for (const Json& word : json.value("error_of", Json::array())) {
    if (word.is_string()) out.error_of.push_back(word);
  }
  for (const Json& group : json.value("source_groups", Json::array())) {
    if (!group.is_object() || !group.contains("batch_share")) continue;
    const Json& share = group["batch_share"];
    if (!share.is_number() || !(share.get<double>() > 0 && share.get<double>() <= 1))
      return problem_in(file, "a batch_share is not between 0 and 1: run the scene again");
    out.batch_shares.push_back(share);
  }
  return out;
}

Result<SceneOfRun> scene_of_run(const FinishedRun& run) {
  const auto [description, told] =
      load_scene(run.scene_file, ReadingWarnings::left_to_inspection, run.at_s);
  if (!description)
    return problem_in(run.scene_file, "the run's scene cannot be read any more", told);
  const std::string name = description->scenarios.empty() ? "" : run.scenario;
  auto scenario = find_scenario(*description, name);
  if (!scenario) return scenario.problem();
  auto scene =
      compile_scene(description, scenario.value(), {run.cells, run.error_of, run.batch_shares});
  if (!scene) return scene.problem();
  return SceneOfRun{std::move(scenario).value(), std::move(scene).value()};
}

Result<SceneState> scene_of_folder(const fs::path& folder) {
  std::error_code ignored;
  const fs::path assessed = folder / "assessment.json";
  if (!fs::exists(folder / "result.json", ignored) && fs::exists(assessed, ignored)) {
    const auto read = read_json_file(assessed);
    if (!read) return read.problem();
    const Json scene = read->is_object() ? read->value("scene", Json()) : Json();
    if (!has_text(scene, "file") || !has_text(scene, "scenario"))
      return problem_in(assessed, "this is no assessment: assess the scene again");
    return SceneState{scene["file"], scene["scenario"]};
  }
  const auto run = read_finished_run(folder);
  if (!run) return run.problem();
  return SceneState{run->scene_file, run->scenario, run->at_s};
}

}  // namespace luxodus::cli
