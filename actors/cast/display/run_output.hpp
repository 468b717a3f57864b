// What a display does with totals: whoever has a run shown says how. The display itself knows how
// it comes by them. Thread rule: wants_show() and fresh_run() on the node's thread; show(),
// keep_flux() and write_results() on a thread of the display, one call at a time.
#pragma once

#include <memory>

#include "actors/results/run/local_run.hpp"

namespace luxodus {

class RunOutput {
 public:
  virtual ~RunOutput() = default;
  /// A run without totals, which a copy of them is put into.
  virtual std::unique_ptr<LocalRun> fresh_run() = 0;
  /// The most memory that a picture takes [bytes]; for a memory plan.
  virtual uint64_t picture_bytes() const = 0;
  /// Whether something of the run in progress is to be shown now.
  virtual bool wants_show() = 0;
  /// Shows a run in progress. What goes wrong is logged: the run goes on.
  virtual void show(const LocalRun& run) = 0;
  /// The run is over, for this reason: has its flux on the disk, under its name, when this returns.
  /// Errors: it cannot be written.
  virtual Result<void> keep_flux(const LocalRun& run, StopReason reason) = 0;
  /// Writes all else that the run leaves. Follows keep_flux. Errors: it cannot be written.
  virtual Result<void> write_results(const LocalRun& run, StopReason reason) = 0;
};

}  // namespace luxodus
