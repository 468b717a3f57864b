// All that the nodes of one process are made from, where options say what there is, and no
// cluster's file does: their graph, who holds what, what each may take. Threads run them
// (in_process.hpp), or a simulation does.
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
/// Workers of one process: a thread each; more belong on more machines.
inline constexpr int nodes_in_process = 64;
}  // namespace limits

/// Of a run where none are said; of one that ends by error or time, for the size of its profile.
inline constexpr int64_t usual_particles = 4'000'000;

struct NodesOptions {
  int nodes = 2;  // workers; the controller comes on top and traces nothing
  int links = 4;  // of a node at most
  /// Nodes that a coordinator leads at most; 0: usual_fan_out(). Beyond that there are several
  /// levels, and their coordinators trace nothing.
  uint32_t fan_out = 0;
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
  size_t prefetch = 0;        // cells asked for ahead of the one that is waited for
  double pinned_share = 0.5;  // of a budget, for objects that the plan has kept for good
  /// Of every link, on purpose: what a distance would cost, and how many fibers hide it.
  Nanoseconds link_delay = 0;
  double link_bytes_per_second = 0;  // likewise, each way; 0: as fast as may be
  std::optional<Graph> graph;        // of the links; else the minimum-path graph
  /// Folder of the local sockets by which nodes of several processes meet; without it all are of
  /// one process, and links are memory.
  std::string sockets;
  Nanoseconds lease_time = CoordinatorConfig{}.lease_time;
  Nanoseconds lost = CoordinatorConfig{}.lost;     // a node without a way to it for so long is
  std::vector<Fault> faults;                       // what happens to nodes, on purpose
  uint64_t tally_bytes = NodeSetup{}.tally_bytes;  // of each node, for scores, totals and flushes
  int tally_shards = 1;  // of the totals: the controller's, and those of the first workers
  Observation* observation = nullptr;  // where somebody watches
  RunOutput* display = nullptr;        // shows the run; null: nobody does
  std::optional<NodeId> display_node;  // where; by the controller's node unless said
  /// Asked by each worker every few milliseconds, on its own thread: whether it shall end
  /// before the run does.
  std::function<bool()> stop = [] { return false; };
};

/// What no run can have, and the option that says it.
struct CoordinationFault {
  std::string_view option;
  std::string what;
};
/// Whether so many nodes can be led and hold the totals like that; none where they can.
std::optional<CoordinationFault> coordination_fault(int nodes, uint32_t fan_out, int tally_shards);

/// The minimum-path graph of so many workers and a controller. Errors: as find_amp.
Result<Graph> graph_of_process(int nodes, int links);

class PlannedNodes {
 public:
  /// `run_id` is not 0, and another for every run. Requires: `run` outlives this.
  /// Errors: no graph of so few links, options that contradict each other or the scene, a budget
  /// that is too small.
  static Result<std::unique_ptr<PlannedNodes>> make(const LocalRun& run,
                                                    const NodesOptions& options,
                                                    const StopRule& stop, uint64_t run_id);

  const RunSetup& setup() const { return setup_; }
  const std::vector<NodeSetup>& workers() const { return workers_; }
  const NodeSetup& controller() const { return controller_; }
  /// Where a profile has planned who traces, holds and keeps what.
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
