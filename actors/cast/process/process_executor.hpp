// Nodes of this process that trace what is given to them, a thread each, linked as a minimum-path
// graph. Thread rule: made and ended on one thread.
#pragma once

#include <atomic>
#include <memory>

#include "actors/cast/process/node_executor.hpp"
#include "actors/cast/process/node_threads.hpp"
#include "actors/cast/process/planned_nodes.hpp"

namespace luxodus {

class ProcessExecutor {
 public:
  /// Nodes whose states are made by `states` of what is entered. `scene`: what their handshake is
  /// about. Requires: `states` outlives this. Errors: no graph of so few links; no sockets left.
  static Result<std::unique_ptr<ProcessExecutor>> start(std::shared_ptr<const CompiledScene> scene,
                                                        StateMaker& states,
                                                        const NodesOptions& options);
  /// Requires: executor() is used no more.
  ~ProcessExecutor();

  const std::shared_ptr<NodeExecutor>& executor() const { return executor_; }

 private:
  explicit ProcessExecutor(std::shared_ptr<const CompiledScene> scene);

  SystemClock clock_;
  ZmqContext context_{{}};
  Machine machine_{clock_, context_};
  LocalRun run_;
  std::unique_ptr<PlannedNodes> nodes_;
  std::optional<RunSetup> setup_;
  std::shared_ptr<NodeExecutor> executor_;
  std::atomic<bool> ends_{false};
  std::unique_ptr<WorkerThreads> workers_;
};

}  // namespace luxodus
