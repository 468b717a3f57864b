// A run on several nodes of this process: workers and a controller, each a thread, linked over
// inproc as a minimum-path graph. The flux is that of the plain loop, bit for bit.
// Thread rule: called from one thread, which becomes the controller's.
#pragma once

#include <atomic>
#include <functional>

#include "actors/source/local_run.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Workers of one process: a thread each; more belong on more machines.
inline constexpr int nodes_in_process = 64;
}  // namespace limits

struct NodesOptions {
  int nodes = 2;         // workers; the controller comes on top and traces nothing
  int links = 4;         // of a node at most
  size_t fibers = 1;     // photon-threads of a node
  size_t portion = 128;  // particles a fiber takes at once
  /// For built geometry cells, of each node. 0: everything is resident, and shared. With a budget
  /// each node holds its share of the cells' bytes for all, and fetches and builds what it needs.
  size_t object_bytes = 0;
  uint32_t replicas = 1;  // nodes that hold a cell's bytes
};

/// What the nodes of a run did, for a line to people and for tests.
struct NodesReport {
  uint64_t flushes = 0;
  uint64_t flush_bytes = 0;
  uint64_t leases = 0;
  uint64_t leases_fenced = 0;
  uint64_t frames = 0;
  // Of all workers, where they fetch:
  uint64_t hits = 0;
  uint64_t fetches = 0;
  uint64_t joined = 0;
  uint64_t builds = 0;
  uint64_t evictions = 0;
  uint64_t fetched_bytes = 0;
  uint64_t largest_resident_bytes = 0;  // of one node
};

/// Traces until `stop` holds, into `run`'s totals; as LocalRun::run.
/// Errors: no graph of so few links, no sockets left.
Result<StopReason> run_on_nodes(LocalRun& run, const NodesOptions& options, const StopRule& stop,
                                const std::atomic<bool>& interrupt,
                                const std::function<void(const Progress&)>& report,
                                NodesReport* counted = nullptr);

}  // namespace luxodus
