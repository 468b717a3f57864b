// The results of a run on disk: result.json, the planes as tables and pictures, patches and voxels
// for ParaView. Every value with standard error and unit. Reads the run, changes nothing.
#pragma once

#include <filesystem>
#include <optional>

#include "actors/display/maps.hpp"
#include "actors/output/json_out.hpp"
#include "actors/run/local_run.hpp"

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

/// Writes result.json, planes/*.csv and *.png, patches.vtp and volume.vti into `folder` (made if
/// missing). Maps and pictures of an earlier run are removed first; nothing else in the folder is.
/// Until all is written, result.json is begun_json. Returns what it wrote as result.json.
/// `progress` is of the direct light, which takes longest.
Result<Json> write_report(const std::filesystem::path& folder, const LocalRun& run,
                          const RunRecord& record, const ShareDone& progress = {});

/// For the terminal: the state that was computed; the values asked for, a line each (planes,
/// probes, groups of surfaces, counting planes, signs by observer); where the light went; the
/// errors. `verbose`: and how it was computed. Requires: `result` is the run's result_json.
std::string summary_text(const Json& result, bool verbose = false);

}  // namespace luxodus
