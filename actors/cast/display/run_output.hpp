// What a display does with totals, implemented by the program that shows a run. The display itself
// obtains the totals. Thread rule: wants_show() and fresh_run() on the node's thread; show(),
// keep_flux() and write_results() on a thread of the display, one call at a time.
#pragma once

#include <memory>

#include "actors/results/run/local_run.hpp"

namespace luxodus {

class RunOutput {
 public:
  virtual ~RunOutput() = default;
  /// A run without totals, to receive a copy of them.
  virtual std::unique_ptr<LocalRun> fresh_run() = 0;
  /// The most memory of a picture [bytes]; for a memory plan.
  virtual uint64_t picture_bytes() const = 0;
  /// Whether something of the run in progress is to be shown now.
  virtual bool wants_show() = 0;
  /// Shows a run in progress. Failures are only logged: the run goes on.
  virtual void show(const LocalRun& run) = 0;
  /// The run is over, for this reason: writes its flux to the disk, under its final name. Errors:
  /// it cannot be written.
  virtual Result<void> keep_flux(const LocalRun& run, StopReason reason) = 0;
  /// Writes all other results. Follows keep_flux. Errors: they cannot be written.
  virtual Result<void> write_results(const LocalRun& run, StopReason reason) = 0;
};

}  // namespace luxodus
