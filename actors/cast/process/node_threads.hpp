// The real nodes of a process: each a thread, with the machine's clock and sockets. Thread rule:
// called from one thread, which becomes the controller's.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "actors/cast/node/controller_node.hpp"
#include "actors/cast/node/worker.hpp"
#include "actors/cast/parts/residency.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// Statistics of a run's nodes.
struct NodesReport {
  uint64_t flushes = 0;
  uint64_t flush_bytes = 0;
  uint64_t leases = 0;
  uint64_t leases_fenced = 0;
  uint64_t frames = 0;
  ShardControl::Counters shards;
  WorkerReport workers;  // over all workers
  std::vector<WorkerReport> by_node;
  std::optional<Residency> residency;  // if there was a plan
  Nanoseconds took = 0;                // from the arrival of all workers to the last batch's count
  uint64_t longest_turn = 0;           // [ns] of CPU time, of the controller
};

/// Runs a worker on the calling thread until it has left; see Worker::start. Errors: those of
/// join_links and Worker::result.
Result<WorkerReport> run_worker(const RunSetup& run, const Machine& machine, const NodeSetup& node,
                                const std::function<bool()>& stop);
/// Like run_worker, with another tracing loop than the program's own.
Result<WorkerReport> run_worker_by(const TracerMaker& make_tracer, const RunSetup& run,
                                   const Machine& machine, const NodeSetup& node,
                                   const std::function<bool()>& stop);

/// The type of run_worker.
using RunWorker =
    std::function<Result<WorkerReport>(const RunSetup& run, const Machine& machine,
                                       const NodeSetup& node, const std::function<bool()>& stop)>;

/// Threads that run one worker each, and the first problem of any of them.
class WorkerThreads {
 public:
  /// Starts them. Requires: `run`, `machine` and `nodes` outlive this; all threads may call `stop`.
  WorkerThreads(const RunSetup& run, const Machine& machine, const std::vector<NodeSetup>& nodes,
                const std::function<bool()>& stop, const RunWorker& run_one = run_worker);
  ~WorkerThreads() { join(); }
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  void join();
  bool failed() const { return failed_; }
  /// Requires: failed().
  Problem problem() const;
  /// Why a worker left before the end: one of its actors had failed. The others continue without
  /// it. Requires: joined.
  const std::optional<Problem>& lost() const { return lost_; }
  /// Requires: joined.
  WorkerReport report() const;
  /// By number. Requires: joined.
  const std::vector<WorkerReport>& by_node() const { return reports_; }

 private:
  void work(const RunSetup& run, const Machine& machine, const NodeSetup& node,
            const std::function<bool()>& stop, const RunWorker& run_one);

  mutable std::mutex mutex_;
  std::vector<WorkerReport> reports_;
  Problem problem_;
  std::optional<Problem> lost_;
  std::atomic<bool> failed_{false};
  std::vector<std::thread> threads_;
};

/// Runs the controller's node on the calling thread until the run has ended or `broken` returns
/// true. Errors: those of join_links.
Result<StopReason> run_controller(const RunSetup& setup, const Machine& machine,
                                  const NodeSetup& node, ControlledRun lead,
                                  const std::function<bool()>& broken,
                                  NodesReport* counted = nullptr);

}  // namespace luxodus
