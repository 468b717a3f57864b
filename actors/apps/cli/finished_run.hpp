// What a finished run or assessment left says of the scene that it was of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "actors/results/formats/json_out.hpp"
#include "runtime/core/result.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus::cli {

/// Errors: as read_whole_file. What is no JSON is a discarded value.
Result<Json> read_json_file(const std::filesystem::path& file);

/// result.json of a run, as far as others need it.
struct FinishedRun {
  std::string scene_file, scenario;
  uint64_t seed = 0;
  int cells = 1;
  std::vector<std::string> error_of;
  std::vector<double> batch_shares;  // of its source groups, where they were dealt by need
  int64_t batches = 0;
  std::optional<double> at_s;     // of --at, where it was given
  std::optional<double> seconds;  // that these batches took, where all of it is known
};

/// Errors: no result.json in the folder, or one that is not of a run; an assessment is called that.
Result<FinishedRun> read_finished_run(const std::filesystem::path& folder);

/// The scene that a run was of, as it was compiled for it.
struct SceneOfRun {
  Scenario scenario;
  std::shared_ptr<const CompiledScene> scene;
};

/// Tells problems of the scene file. Errors: it cannot be read any more, or has no such scenario.
Result<SceneOfRun> scene_of_run(const FinishedRun& run);

/// A state of a building, by its scene file.
struct SceneState {
  std::string scene_file, scenario;
  std::optional<double> at_s = {};
};

/// Of the folder of a run (result.json), or of an assessment (assessment.json).
/// Errors: neither is there, or what is there is not of one.
Result<SceneState> scene_of_folder(const std::filesystem::path& folder);

}  // namespace luxodus::cli
