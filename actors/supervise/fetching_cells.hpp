// What a node needs that does not hold all geometry: a store for what it holds for others, a cache
// for itself, and the way to everybody else's. Thread rule: the node's thread.
#pragma once

#include "actors/supervise/node_setup.hpp"
#include "actors/supervise/node_shell.hpp"

namespace luxodus {

/// What the caches of nodes did, for a line to people and for tests.
struct WorkerReport {
  uint64_t hits = 0;
  uint64_t fetches = 0;
  uint64_t joined = 0;  // fibers that found a fetch under way
  uint64_t builds = 0;
  uint64_t evictions = 0;
  uint64_t waited = 0;  // [ns] with nothing to do
  uint64_t fetched_bytes = 0;
  uint64_t largest_resident_bytes = 0;  // of one node, when it ended

  void add(const WorkerReport& other);
};

class FetchingCells {
 public:
  /// Requires: run.objects is not null; all outlive this.
  FetchingCells(const RunSetup& run, const NodeSetup& node, NodeShell& shell,
                NodeTrace* trace = nullptr);

  ObjectSource& source() { return source_; }
  void add_metrics(Metrics& metrics) const;
  WorkerReport report() const;

 private:
  HeldCells store_;
  CellBuilder builder_;
  Fetcher fetcher_;
  ObjectCache cache_;
  CachedCells source_;
};

}  // namespace luxodus
