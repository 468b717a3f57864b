// The results of a run on disk: result.json, the planes as tables and pictures, patches and voxels
// for ParaView. Every value with standard error and unit. Reads the run, changes nothing.
#pragma once

#include <filesystem>
#include <optional>

#include "actors/results/files/maps.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

/// How the run came to its end, for the record.
struct RunRecord {
  std::string scene_file;
  std::string stopped_by;  // name_of(StopReason)
  int cells = 1;
  StopRule stop = {};               // what was asked for
  std::optional<double> at_s = {};  // of --at, where it was given
};

/// result.json as a value. `maps`: make_plane_maps of the run.
Json result_json(const LocalRun& run, const RunRecord& record);
Json result_json(const LocalRun& run, const RunRecord& record, const PlaneMaps& maps);

/// What result.json says while a run goes on or its results are being written: what `luxodus
/// render` and `run --resume` need, which files are its own, and that it has not ended.
Json begun_json(const LocalRun& run, const RunRecord& record, double seconds);

/// Makes `folder` ready for the results of a run: maps and pictures of an earlier one are removed,
/// nothing else, and result.json is begun_json. Files of the run may be written from then on.
Result<void> begin_results(const std::filesystem::path& folder, const LocalRun& run,
                           const RunRecord& record);

/// Writes planes/*.csv and *.png, patches.vtp and volume.vti into `folder`, then result.json, which
/// it returns. `progress` is of the direct light, which takes longest.
/// Requires: begin_results of the same run and record.
Result<Json> finish_results(const std::filesystem::path& folder, const LocalRun& run,
                            const RunRecord& record, const ShareDone& progress = {});

/// For the terminal: the state that was computed; the values asked for, a line each (planes,
/// probes, groups of surfaces, counting planes, signs by observer); where the light went; the
/// errors. `verbose`: and how it was computed. Requires: `result` is the run's result_json.
std::string summary_text(const Json& result, bool verbose = false);

}  // namespace luxodus
