// Writes the results of a run: result.json, the planes as tables and pictures, patches and voxels
// for ParaView. Every value has its standard error and unit. Reads the run only; one call at a time
// per run.
#pragma once

#include <filesystem>
#include <optional>

#include "actors/results/files/maps.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/run/local_run.hpp"

namespace luxodus {

/// How the run ended, for the record.
struct RunRecord {
  std::string scene_file;
  std::string stopped_by;  // name_of(StopReason)
  int cells = 1;
  StopRule stop = {};               // the stopping rule that was asked for
  std::optional<double> at_s = {};  // from --at, where given
};

/// result.json as a value. `maps`: make_plane_maps of the run.
Json result_json(const LocalRun& run, const RunRecord& record);
Json result_json(const LocalRun& run, const RunRecord& record, const PlaneMaps& maps);

/// The result.json of a run that goes on or whose results are being written: it holds what
/// `luxodus render` and `run --resume` need, names the run's files, and says that the run has not
/// ended.
Json begun_json(const LocalRun& run, const RunRecord& record, double seconds);

/// Prepares `folder` for the results of a run: removes the maps and pictures of an earlier one, and
/// nothing else, and writes begun_json. From then on files of the run may be written.
Result<void> begin_results(const std::filesystem::path& folder, const LocalRun& run,
                           const RunRecord& record);

/// Writes planes/*.csv and *.png, patches.vtp and volume.vti into `folder`, then result.json, which
/// it returns. `progress` counts the direct light, which takes longest.
/// Errors: files that cannot be written; then, a value that is out of range, which they do not
/// hold. Requires: begin_results of the same run and record.
Result<Json> finish_results(const std::filesystem::path& folder, const LocalRun& run,
                            const RunRecord& record, const ShareDone& progress = {});

/// Text for the terminal: the computed state; the requested values, a line each (planes, probes,
/// groups of surfaces, counting planes, signs by observer); the energy balance; the errors.
/// `verbose`: also how it was computed. Requires: `result` is the run's result_json.
std::string summary_text(const Json& result, bool verbose = false);

}  // namespace luxodus
