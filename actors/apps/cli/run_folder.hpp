// The folder of a run: checked, locked and protected before anything is traced. Rules for what may
// be replaced there:
// - files that no run has written: only with --overwrite;
// - a run of another scene, scenario or state of the scene file: always;
// - a run of the same scene: if the new run is sure to be at least as long, so that a command can
//   be repeated; if it may be shorter, only with --overwrite, since --resume was likely forgotten;
// - a longer run that may be replaced stays until the new run has become longer; it also stays if
//   the new run is interrupted before that.
// One thread.
#pragma once

#include <memory>

#include "actors/results/formats/output_folder.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/storage/room_reserve.hpp"

namespace luxodus::cli {

struct RunFolderOptions {
  StopRule stop;
  bool resume = false;
  bool overwrite = false;
  bool views = true;
};

struct RunFolder {
  OutputFolder output;
  bool goes_on = false;        // continues the flux file there
  int64_t keep_particles = 0;  // particles of a run of the same scene there that is not resumed
  std::unique_ptr<RoomReserve> room = std::make_unique<RoomReserve>();

  const std::filesystem::path& path() const { return output.path(); }
};

/// Errors: as OutputFolder::claim; files that are not a run's, a run that may be longer, --resume
/// without anything to resume.
Result<RunFolder> claim_run_folder(const std::filesystem::path& folder, const CompiledScene& scene,
                                   const RunFolderOptions& options);

}  // namespace luxodus::cli
