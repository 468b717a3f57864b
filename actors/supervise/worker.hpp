// A worker: a node that traces. It is made and run on one thread; what it does for others (routes,
// objects it holds) it does between the turns of its photon-threads.
#pragma once

#include <deque>

#include "actors/photon/lease_client.hpp"
#include "actors/supervise/fetching_cells.hpp"
#include "actors/supervise/node_metrics.hpp"
#include "actors/tally/tally_shard.hpp"

namespace luxodus {

class Worker {
 public:
  /// Requires: both outlive this.
  Worker(const RunSetup& run, const NodeSetup& node);
  ~Worker();

  /// Traces until the controller says that the run has ended; or until `stop` says so, when what is
  /// at hand is traced and given to the controller before this node leaves.
  /// Errors: as join_links; a controller that never came, was lost, or could not begin.
  Result<WorkerReport> run(const std::function<bool()>& stop);

 private:
  void show_to(Observation& seen);
  Post post();
  void deliver_own();
  std::unique_ptr<TallyShard> own_shard();

  const RunSetup& run_;
  const NodeSetup& node_;
  NodeTrace* const trace_;  // null where nothing is traced
  NodeTransport transport_;
  NodeShell shell_;
  std::unique_ptr<FetchingCells> cells_;  // where the node does not hold everything
  struct OwnMessage {
    MessageId id;
    Message message;
    SharedBytes payload;
  };
  std::deque<OwnMessage> own_messages_;
  std::unique_ptr<TallyShard> shard_;  // where it holds one of the totals
  PartSender parts_;
  LeaseClient leases_;
  PhotonThreads photons_;
  std::optional<NodeMetrics> metrics_;
};

}  // namespace luxodus
