// Who traces a run: threads of this process, or nodes (actors/supervise/in_process.hpp). The flux
// is the same, bit for bit. Thread rule: one caller.
#pragma once

#include <atomic>
#include <functional>

#include "actors/run/local_run.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

class RunExecutor {
 public:
  virtual ~RunExecutor() = default;
  /// Traces until `stop` holds or `interrupt` is set, into the run's totals; as LocalRun::run.
  /// Errors: of nodes: those of run_on_nodes.
  virtual Result<StopReason> run(LocalRun& run, const StopRule& stop,
                                 const std::atomic<bool>& interrupt,
                                 const std::function<void(const Progress&)>& report) = 0;
};

/// The threads that the run was made for.
class RunThreads final : public RunExecutor {
 public:
  Result<StopReason> run(LocalRun& run, const StopRule& stop, const std::atomic<bool>& interrupt,
                         const std::function<void(const Progress&)>& report) override {
    return run.run(stop, interrupt, report);
  }
};

}  // namespace luxodus
