// Setup of all nodes of one process from options, without a cluster file: their graph, the holders
// of objects, their budgets. Threads run them (in_process.hpp), or a simulation. Thread rule: made
// on one thread; immutable while the nodes run, except residency().
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "actors/cast/node/node_setup.hpp"
#include "actors/cast/parts/residency.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Most workers of one process, a thread each; more belong on more machines.
inline constexpr int nodes_in_process = 64;
}  // namespace limits

/// Assumed particles of a run without a limit on them (it ends by error or time), for the size of
/// its profile.
inline constexpr int64_t usual_particles = 4'000'000;

struct NodesOptions {
  int nodes = 2;  // workers; the controller comes on top and traces nothing
  int links = 4;  // per node, at most
  /// Most nodes that a coordinator leads; 0: usual_fan_out(). With more there are several levels,
  /// and their coordinators trace nothing.
  uint32_t fan_out = 0;
  size_t fibers = 1;     // photon-threads per node
  size_t portion = 128;  // most particles that a fiber takes at once
  /// Budget for built objects of each node. 0: everything is resident and shared. With a budget
  /// each node holds its share of the objects' bytes for all, and fetches and builds what it needs.
  size_t object_bytes = 0;
  uint32_t replicas = 1;  // holders of each object
  bool sharing = true;    // an object used by several nodes is built once and shared
  /// With a budget: the share of the run's particles that is traced beforehand, to plan which node
  /// traces, holds and pins what. 0: no plan.
  double profile_share = 0.01;
  size_t prefetch = 0;        // cells prefetched for a fiber that waits for one
  double pinned_share = 0.5;  // largest share of a budget for pinned objects
  /// Injected delay of every link: the cost of a distance, and how many fibers hide it.
  Nanoseconds link_delay = 0;
  double link_bytes_per_second = 0;  // injected limit, each way; 0: none
  std::optional<Graph> graph;        // of the links; otherwise the minimum-path graph
  /// Folder of the local sockets by which nodes of several processes connect; without it all nodes
  /// are in one process, and links are memory.
  std::string sockets;
  Nanoseconds lease_time = CoordinatorConfig{}.lease_time;
  Nanoseconds lost = CoordinatorConfig{}.lost;     // a node unreachable for this long is lost
  std::vector<Fault> faults;                       // injected faults of nodes
  uint64_t tally_bytes = NodeSetup{}.tally_bytes;  // of each node, for scores, totals and flushes
  int tally_shards = 1;  // of the totals: the controller's, and those of the first workers
  Observation* observation = nullptr;  // null: no metrics and traces
  RunOutput* display = nullptr;        // shows the run; null: none
  std::optional<NodeId> display_node;  // its node; by default the controller's
  /// Called by each worker every few milliseconds, on its own thread: whether it shall end before
  /// the run does.
  std::function<bool()> stop = [] { return false; };
};

/// An invalid combination of options, and the option to change.
struct CoordinationFault {
  std::string_view option;
  std::string what;
};
/// Whether this many nodes can be led and hold the totals in this way; nothing if they can.
std::optional<CoordinationFault> coordination_fault(int nodes, uint32_t fan_out, int tally_shards);

/// The minimum-path graph of this many workers and a controller. Errors: those of find_amp.
Result<Graph> graph_of_process(int nodes, int links);

class PlannedNodes {
 public:
  /// `run_id` is not 0, and unique for every run. Requires: `run` outlives this. Errors: no graph
  /// with so few links, options that contradict each other or the scene, a budget that is too
  /// small.
  static Result<std::unique_ptr<PlannedNodes>> make(const LocalRun& run,
                                                    const NodesOptions& options,
                                                    const StopRule& stop, uint64_t run_id);

  const RunSetup& setup() const { return setup_; }
  const std::vector<NodeSetup>& workers() const { return workers_; }
  const NodeSetup& controller() const { return controller_; }
  /// The residency plan, if a profile was made.
  std::optional<Residency>& residency() { return residency_; }

 private:
  PlannedNodes(const LocalRun& run, const NodesOptions& options, Graph graph);
  Result<void> plan_residency(const LocalRun& run, const NodesOptions& options,
                              const StopRule& stop);
  void set_up(const NodesOptions& options, uint64_t run_id);

  const Graph graph_;
  const CoordinationTree tree_;
  const Routes routes_;
  const EmbreeDevice device_;
  std::optional<SceneObjects> objects_;
  std::optional<ProxyScene> proxies_;
  std::optional<SharedObjects> shared_;
  RunSetup setup_;
  std::vector<NodeSetup> workers_;
  NodeSetup controller_;
  std::optional<Residency> residency_;
};

}  // namespace luxodus
