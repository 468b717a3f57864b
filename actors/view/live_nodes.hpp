// Nodes of this process that trace for a live view, a thread each, linked as a minimum-path graph.
// Thread rule: made and ended on one thread.
#pragma once

#include <memory>

#include "actors/supervise/node_threads.hpp"
#include "actors/supervise/planned_nodes.hpp"
#include "actors/view/live_cluster.hpp"
#include "actors/view/live_worker.hpp"

namespace luxodus {

class LiveNodes {
 public:
  /// Errors: a scene that does not compile; no graph of so few links; no sockets left.
  static Result<std::unique_ptr<LiveNodes>> start(std::shared_ptr<const SceneDescription> scene,
                                                  const NodesOptions& options);
  /// Requires: tracers() are used no more.
  ~LiveNodes();

  const std::shared_ptr<LiveCluster>& tracers() const { return cluster_; }

 private:
  explicit LiveNodes(std::shared_ptr<const SceneDescription> scene);

  SystemClock clock_;
  ZmqContext context_{{}};
  Machine machine_{clock_, context_};
  LiveStates states_;
  std::unique_ptr<LocalRun> run_;  // what the nodes' handshake is about
  std::unique_ptr<PlannedNodes> nodes_;
  std::shared_ptr<LiveCluster> cluster_;
  std::atomic<bool> ends_{false};
  std::unique_ptr<WorkerThreads> workers_;
};

}  // namespace luxodus
