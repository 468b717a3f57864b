// The totals of a run on disk while it goes on, so that a run that is killed is resumed with what
// it had, bit for bit. Between batches flux.lux is replaced whole; result.json says that the run
// has not ended. Thread rule: made and destroyed by whoever runs the run.
#pragma once

#include <chrono>
#include <filesystem>

#include "actors/results/files/run_results.hpp"

namespace luxodus {

/// Puts the totals of a run that goes on into its folder, with the time that they took. With the
/// `first` of a run the maps of an earlier one go. Errors: as write_json and save_flux.
Result<void> save_checkpoint(const std::filesystem::path& folder, const LocalRun& run,
                             const RunRecord& record, double seconds, bool first);

class Checkpoint {
 public:
  /// Saves from now on while `run` traces, `every_s` seconds apart. What the folder holds of an
  /// earlier run is replaced with the first: not before the run has more than `keep_particles`.
  /// A checkpoint that cannot be written is logged; the run goes on. Requires: `run` outlives this;
  /// `every_s` is longer than it takes to begin a batch, or the run does nothing else.
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
