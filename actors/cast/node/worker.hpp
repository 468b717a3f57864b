// A worker: a node that traces, or that coordinates others on behalf of the controller. Its
// services for others (routing, objects that it holds) run between the turns of its photon-threads.
// Thread rule: made and run on one thread.
#pragma once

#include "actors/cast/node/fetching_objects.hpp"
#include "actors/cast/node/node_metrics.hpp"
#include "actors/cast/tally/tally_shard.hpp"
#include "actors/cast/tracing/state_tracer.hpp"
#include "actors/cast/tracing/tracing_worker.hpp"

namespace luxodus {

class Worker {
 public:
  /// Requires: all references outlive this.
  Worker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams);
  ~Worker();

  /// From the shell's next turn on traces until the controller ends the run; or until `stop`
  /// returns true: then work at hand is finished and flushed before this node leaves.
  void start(std::function<bool()> stop);

  /// To run it, or to give it its turns.
  NodeShell& shell() { return shell_; }
  const NodeShell& shell() const { return shell_; }
  const TracingWorker& tracer() const { return tracer_; }
  /// Null if it coordinates, or traces states.
  const TracingFibers* photons() const { return photons_.get(); }
  /// Null if it traces.
  const SubCoordinator* coordinator() const { return coordinator_.get(); }
  /// Null if the node holds the whole scene.
  const FetchingObjects* objects() const { return objects_.get(); }

  /// Its statistics; WorkerReport::failed is set if it left since one of its actors failed. Errors:
  /// a controller that never appeared, was lost, or could not begin. Requires: shell().finished().
  Result<WorkerReport> result() const;

 private:
  void show_to(Observation& seen);
  bool may_leave();
  bool leaves_early();
  bool end_run(const Verdict& verdict);
  std::unique_ptr<TallyShard> own_shard();
  std::unique_ptr<TracingFibers> own_photons(const NodeSeams& seams);
  std::unique_ptr<StateTracer> own_states(const NodeSeams& seams);
  std::unique_ptr<SubCoordinator> own_coordinator();
  LeasedWork& work();
  bool coordinates() const { return run_.coordinates(node_.net.self); }

  const RunSetup& run_;
  const NodeSetup& node_;
  NodeTrace* const trace_;  // null: no tracing
  NodeShell shell_;
  std::unique_ptr<FetchingObjects> objects_;  // if the node does not hold the whole scene
  std::unique_ptr<TallyShard> shard_;         // if it holds one
  TracingWorker tracer_;
  // The executor of its leases: one of these.
  std::unique_ptr<TracingFibers> photons_;
  std::unique_ptr<SubCoordinator> coordinator_;
  std::unique_ptr<StateTracer> states_;
  std::unique_ptr<BlockingCalls> display_calls_;
  std::optional<DisplayActor> display_;  // if the run is shown here
  std::optional<NodeMetrics> metrics_;
  std::function<bool()> stop_;
  Nanoseconds leave_at_ = never;
};

}  // namespace luxodus
