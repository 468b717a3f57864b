// A worker: a node that traces. It is made and run on one thread; what it does for others (routes,
// objects it holds) it does between the turns of its photon-threads.
#pragma once

#include "actors/photon/lease_client.hpp"
#include "actors/supervise/node_metrics.hpp"
#include "actors/supervise/node_setup.hpp"
#include "actors/supervise/node_shell.hpp"

namespace luxodus {

/// What a worker did, for a line to people and for tests.
struct WorkerReport {
  uint64_t hits = 0;
  uint64_t fetches = 0;
  uint64_t joined = 0;  // fibers that found a fetch under way
  uint64_t builds = 0;
  uint64_t evictions = 0;
  uint64_t fetched_bytes = 0;
  uint64_t largest_resident_bytes = 0;  // of one node, when it ended

  void add(const WorkerReport& other);
};

class Worker {
 public:
  /// Requires: both outlive this.
  Worker(const RunSetup& run, const NodeSetup& node);
  ~Worker();

  /// Traces until the controller says that the run has ended, or `stop` does.
  /// Errors: as join_links.
  Result<WorkerReport> run(const std::function<bool()>& stop);

 private:
  class FetchingCells;
  void show_to(Observation& seen);

  const RunSetup& run_;
  const NodeSetup& node_;
  NodeTrace* const trace_;  // null where nothing is traced
  ZmqTransport transport_;
  NodeShell shell_;
  std::unique_ptr<FetchingCells> cells_;  // where the node does not hold everything
  LeaseClient leases_;
  PhotonThreads photons_;
  std::optional<NodeMetrics> metrics_;
};

}  // namespace luxodus
