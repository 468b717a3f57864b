// Nodes of this process that trace whatever work they are given, one thread each, linked as a
// minimum-path graph. Thread rule: made and destroyed on one thread.
#pragma once

#include <atomic>
#include <memory>

#include "actors/cast/process/node_executor.hpp"
#include "actors/cast/process/node_threads.hpp"
#include "actors/cast/process/planned_nodes.hpp"

namespace luxodus {

class ProcessExecutor {
 public:
  /// Starts nodes whose states are built by `states`. `scene` is compared in their handshake.
  /// Requires: `states` outlives this. Errors: no graph with so few links; no sockets left.
  static Result<std::unique_ptr<ProcessExecutor>> start(std::shared_ptr<const CompiledScene> scene,
                                                        StateMaker& states,
                                                        const NodesOptions& options);
  /// Requires: executor() is no longer used.
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
