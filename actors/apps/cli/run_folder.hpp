// The folder of a run: checked, held and kept from loss before anything is traced. The rule of what
// may be replaced there:
// - files that no run has written are not, without --overwrite;
// - a run of another scene, scenario or state of the scene file is;
// - a run of the same scene is by one that is sure to be at least as long, so that a command can be
//   repeated; by one that may be shorter with --overwrite only: --resume was likely forgotten;
// - until a run that is allowed to replace a longer one has become longer, and where it is
//   interrupted before, that one stays.
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
  bool goes_on = false;        // from the flux file that lies there
  int64_t keep_particles = 0;  // of a run of the same scene there that is not resumed
  std::unique_ptr<RoomReserve> room = std::make_unique<RoomReserve>();

  const std::filesystem::path& path() const { return output.path(); }
};

/// Errors: as OutputFolder::claim; files of others, a run that may be longer, --resume where
/// nothing is to be resumed.
Result<RunFolder> claim_run_folder(const std::filesystem::path& folder, const CompiledScene& scene,
                                   const RunFolderOptions& options);

}  // namespace luxodus::cli
