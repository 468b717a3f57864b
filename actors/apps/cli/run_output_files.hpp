// What `luxodus run` and the nodes of a cluster write about a run: checkpoints and previews in
// progress, then the flux file, result.json, maps and pictures. The plain loop calls it directly;
// on nodes the display does. Thread rule: as RunOutput.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>

#include "actors/cast/display/run_output.hpp"
#include "actors/results/files/checkpoint.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/pictures/pictures.hpp"

namespace luxodus::cli {

struct RunOutputOptions {
  std::filesystem::path folder;
  RunRecord record;                            // all except how the run ended
  double checkpoint_s = 0;                     // between checkpoints; 0: none
  double preview_s = 0;                        // between previews; 0: only on request
  std::atomic<bool>* preview_asked = nullptr;  // set to request a preview; null: no requests
  int64_t keep_particles = 0;  // of a run in the folder that a shorter one does not replace
  bool pictures = false;       // write pictures when the run has ended
  PictureOptions picture;      // options of the pictures
  PictureOptions preview;
  bool patient = false;                     // retry for ten minutes if the disk is full
  std::function<void()> make_room = [] {};  // called before the flux is written
};

class RunOutputFiles final : public RunOutput {
 public:
  /// Requires: `base` outlives this; all copies share its geometry.
  RunOutputFiles(const LocalRun& base, RunOutputOptions options);

  std::unique_ptr<LocalRun> fresh_run() override { return base_.empty_copy(); }
  uint64_t picture_bytes() const override;
  bool wants_show() override { return checkpoint_is_due() || preview_is_due(); }
  void show(const LocalRun& run) override;
  Result<void> keep_flux(const LocalRun& run, StopReason reason) override;
  Result<void> write_results(const LocalRun& run, StopReason reason) override;

  /// The written result.json; null if the folder keeps a longer run.
  const Json& result() const { return result_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool keeps_other(const LocalRun& run, StopReason reason) const;
  bool checkpoint_is_due() const;
  bool preview_is_due() const;

  const LocalRun& base_;
  RunOutputOptions options_;
  std::atomic<Clock::time_point> last_checkpoint_, last_preview_;
  bool checkpointed_ = false;
  Json result_;
};

}  // namespace luxodus::cli
