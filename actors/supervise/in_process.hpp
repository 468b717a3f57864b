// A run on several nodes of this process: workers and a controller, each a thread, linked over
// inproc as a minimum-path graph. The flux is that of the plain loop, bit for bit.
// Thread rule: called from one thread, which becomes the controller's.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "actors/objects/residency.hpp"
#include "actors/source/local_run.hpp"
#include "actors/supervise/worker.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Workers of one process: a thread each; more belong on more machines.
inline constexpr int nodes_in_process = 64;
}  // namespace limits

/// Particles of a run that ends by error or by time, for the size of its profile.
inline constexpr int64_t usual_particles = 4'000'000;

struct NodesOptions {
  int nodes = 2;         // workers; the controller comes on top and traces nothing
  int links = 4;         // of a node at most
  size_t fibers = 1;     // photon-threads of a node
  size_t portion = 128;  // particles a fiber takes at once, at most
  /// For built objects, of each node. 0: everything is resident, and shared. With a budget each
  /// node holds its share of the objects' bytes for all, and fetches and builds what it needs.
  size_t object_bytes = 0;
  uint32_t replicas = 1;  // nodes that hold an object's bytes
  bool sharing = true;    // an object that several nodes have is built once, and is one copy
  /// With a budget: the share of the run's particles that is traced beforehand, to plan who traces,
  /// holds and keeps what. 0: no plan.
  double profile_share = 0.01;
  double pinned_share = 0.5;  // of a budget, for objects that the plan has kept for good
  /// Of every link, on purpose: what a distance would cost, and how many fibers hide it.
  Nanoseconds link_delay = 0;
  Observation* observation = nullptr;  // where somebody watches
  /// Asked by each worker every few milliseconds, on its own thread: whether it shall end before
  /// the run does.
  std::function<bool()> stop = [] { return false; };
};

/// What the nodes of a run did.
struct NodesReport {
  uint64_t flushes = 0;
  uint64_t flush_bytes = 0;
  uint64_t leases = 0;
  uint64_t leases_fenced = 0;
  uint64_t frames = 0;
  WorkerReport workers;  // of all together
  std::vector<WorkerReport> by_node;
  std::optional<Residency> residency;  // where there was a plan
};

/// Threads that run workers, each in one, and the first problem of any of them.
class WorkerThreads {
 public:
  /// Starts them. Requires: `run` and `nodes` outlive this; `stop` may be called by all.
  WorkerThreads(const RunSetup& run, const std::vector<NodeSetup>& nodes,
                const std::function<bool()>& stop);
  ~WorkerThreads() { join(); }
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  void join();
  bool failed() const { return failed_; }
  /// Requires: failed().
  Problem problem() const;
  /// Requires: joined.
  WorkerReport report() const;
  /// By number. Requires: joined.
  const std::vector<WorkerReport>& by_node() const { return reports_; }

 private:
  void work(const RunSetup& run, const NodeSetup& node, const std::function<bool()>& stop);

  mutable std::mutex mutex_;
  std::vector<WorkerReport> reports_;
  Problem problem_;
  std::atomic<bool> failed_{false};
  std::vector<std::thread> threads_;
};

/// Runs the controller's node on the calling thread until the run has ended or `broken` says that
/// it cannot go on. Errors: as join_links.
Result<StopReason> run_controller(const RunSetup& setup, const NodeSetup& node, LocalRun& run,
                                  const StopRule& stop, const std::atomic<bool>& interrupt,
                                  const std::function<void(const Progress&)>& report,
                                  const std::function<bool()>& broken,
                                  NodesReport* counted = nullptr);

/// What each node of such a run may take, in tables. Errors: as run_on_nodes.
Result<std::string> plan_on_nodes(const LocalRun& run, const NodesOptions& options);

/// Traces until `stop` holds, into `run`'s totals; as LocalRun::run.
/// Errors: no graph of so few links, no sockets left, a budget that is too small.
Result<StopReason> run_on_nodes(LocalRun& run, const NodesOptions& options, const StopRule& stop,
                                const std::atomic<bool>& interrupt,
                                const std::function<void(const Progress&)>& report,
                                NodesReport* counted = nullptr);

}  // namespace luxodus
