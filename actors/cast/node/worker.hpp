// A worker: a node that traces, or coordinates others that do in the stead of the controller. It is
// made and run on one thread; what it does for others (routes, objects it holds) it does between
// the turns of its photon-threads.
#pragma once

#include "actors/cast/node/fetching_objects.hpp"
#include "actors/cast/node/node_metrics.hpp"
#include "actors/cast/tally/tally_shard.hpp"
#include "actors/cast/tracing/state_tracing.hpp"
#include "actors/cast/tracing/tracing_worker.hpp"

namespace luxodus {

class Worker {
 public:
  /// Requires: all outlive this.
  Worker(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams);
  ~Worker();

  /// From the shell's next turn on this traces until the controller says that the run has ended; or
  /// until `stop` says so, when what is at hand is traced and given to the controller before this
  /// node leaves.
  void start(std::function<bool()> stop);

  /// Runs it, or gives it its turns.
  NodeShell& shell() { return shell_; }
  const NodeShell& shell() const { return shell_; }
  const TracingWorker& tracer() const { return tracer_; }
  /// Null where it coordinates, or traces states.
  const TracingFibers* photons() const { return photons_.get(); }
  /// Null where it traces.
  const SubCoordinator* coordinator() const { return coordinator_.get(); }
  /// Null where the node holds everything.
  const FetchingObjects* objects() const { return objects_.get(); }

  /// What it did; a node that left since an actor of it had failed says so (WorkerReport::failed).
  /// Errors: a controller that never came, was lost, or could not begin.
  /// Requires: shell().finished().
  Result<WorkerReport> result() const;

 private:
  void show_to(Observation& seen);
  bool may_leave();
  bool leaves_early();
  bool end_run(const Verdict& verdict);
  std::unique_ptr<TallyShard> own_shard();
  std::unique_ptr<TracingFibers> own_photons(const NodeSeams& seams);
  std::unique_ptr<StateTracing> own_states(const NodeSeams& seams);
  std::unique_ptr<SubCoordinator> own_coordinator();
  LeasedWork& work();
  bool coordinates() const { return run_.coordinates(node_.net.self); }

  const RunSetup& run_;
  const NodeSetup& node_;
  NodeTrace* const trace_;  // null where nothing is traced
  NodeShell shell_;
  std::unique_ptr<FetchingObjects> objects_;  // where the node does not hold everything
  std::unique_ptr<TallyShard> shard_;         // where it holds one of the totals
  TracingWorker tracer_;
  // What is done with its leases: one of these.
  std::unique_ptr<TracingFibers> photons_;
  std::unique_ptr<SubCoordinator> coordinator_;
  std::unique_ptr<StateTracing> states_;
  std::unique_ptr<BlockingCalls> display_calls_;
  std::optional<DisplayActor> display_;  // where the run is shown here
  std::optional<NodeMetrics> metrics_;
  std::function<bool()> stop_;
  Nanoseconds leave_at_ = never;
};

}  // namespace luxodus
