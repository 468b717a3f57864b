// Traces a run: threads of this process, nodes made for it (actors/cast/process/in_process.hpp), or
// nodes that trace states of a scene (run_in_pieces.hpp). The flux is the same, bit for bit. Thread
// rule: one caller.
#pragma once

#include <atomic>
#include <functional>

#include "actors/results/run/local_run.hpp"
#include "actors/results/run/scene_state.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

class RunExecutor {
 public:
  virtual ~RunExecutor() = default;
  /// Sets the state from which nodes that know only the scene's file make the scene of the next
  /// runs.
  virtual void enter(const StateObject& /*state*/) {}
  /// Traces until `stop` holds or `interrupt` is set, into the run's totals; as LocalRun::run.
  /// Errors: on nodes, those of run_on_nodes.
  virtual Result<StopReason> run(LocalRun& run, const StopRule& stop,
                                 const std::atomic<bool>& interrupt,
                                 const std::function<void(const Progress&)>& report) = 0;
};

/// The run's own threads.
class RunThreads final : public RunExecutor {
 public:
  Result<StopReason> run(LocalRun& run, const StopRule& stop, const std::atomic<bool>& interrupt,
                         const std::function<void(const Progress&)>& report) override {
    return run.run(stop, interrupt, report);
  }
};

}  // namespace luxodus
