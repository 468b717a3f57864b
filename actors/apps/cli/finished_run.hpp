// Reads from the files of a finished run or assessment which scene it used. Plain values; any
// thread.
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

/// Errors: as read_whole_file. Malformed JSON is a discarded value.
Result<Json> read_json_file(const std::filesystem::path& file);

/// The parts of a run's result.json that other commands need.
struct FinishedRun {
  std::string scene_file, scenario;
  uint64_t seed = 0;
  int cells = 1;
  std::vector<std::string> error_of;
  std::vector<double> batch_shares;  // of its source groups, if they were allocated adaptively
  int64_t batches = 0;
  std::optional<double> at_s;     // from --at, if given
  std::optional<double> seconds;  // of these batches, if known for all
};

/// Errors: no result.json in the folder, or not one of a run; an assessment is named as such.
Result<FinishedRun> read_finished_run(const std::filesystem::path& folder);

/// The scene of a run, compiled as for that run.
struct SceneOfRun {
  Scenario scenario;
  std::shared_ptr<const CompiledScene> scene;
};

/// Prints problems of the scene file. Errors: it can no longer be read, or has no such scenario.
Result<SceneOfRun> scene_of_run(const FinishedRun& run);

/// A state of a building, by its scene file.
struct SceneState {
  std::string scene_file, scenario;
  std::optional<double> at_s = {};
};

/// From the folder of a run (result.json) or of an assessment (assessment.json).
/// Errors: neither exists, or it is malformed.
Result<SceneState> scene_of_folder(const std::filesystem::path& folder);

}  // namespace luxodus::cli
