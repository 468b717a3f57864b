// Checkpoints: saves the totals of a run while it goes on, so that a killed run can be resumed from
// them, bit for bit. Between batches flux.lux is replaced atomically; result.json says that the run
// has not ended. Thread rule: made and destroyed by the thread that runs the run.
#pragma once

#include <chrono>
#include <filesystem>

#include "actors/results/files/run_results.hpp"

namespace luxodus {

/// Writes the totals of a run in progress, with their tracing time, into its folder. The `first`
/// checkpoint of a run removes the maps of an earlier one. Errors: as write_json and save_flux.
Result<void> save_checkpoint(const std::filesystem::path& folder, const LocalRun& run,
                             const RunRecord& record, double seconds, bool first);

class Checkpoint {
 public:
  /// Saves every `every_s` seconds from now on while `run` traces. The first checkpoint replaces an
  /// earlier run's files in the folder, once the run has more than `keep_particles`. A checkpoint
  /// that cannot be written is logged; the run goes on. Requires: `run` outlives this; `every_s` is
  /// longer than beginning a batch takes, or the run does nothing else.
  Checkpoint(std::filesystem::path folder, LocalRun& run, RunRecord record, double every_s,
             int64_t keep_particles);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  int taken() const { return taken_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool due() const { return Clock::now() - last_ >= every_; }
  void take();
  Result<void> save();

  const std::filesystem::path folder_;
  LocalRun& run_;
  const RunRecord record_;
  const std::chrono::duration<double> every_;
  const int64_t keep_particles_;
  const Clock::time_point began_ = Clock::now();
  Clock::time_point last_ = began_;
  int taken_ = 0;
};

}  // namespace luxodus
