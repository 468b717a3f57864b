// Fetching of scene parts for a node that does not hold all of them: a store of what it holds for
// others, a cache for itself, and requests to other nodes. Thread rule: the node's thread.
#pragma once

#include "actors/cast/node/node_setup.hpp"
#include "runtime/fetch/faulty_objects.hpp"
#include "runtime/fetch/part_server.hpp"
#include "runtime/node/node_shell.hpp"

namespace luxodus {

/// Statistics of workers, for the console and for tests.
struct WorkerReport {
  NodeId node;
  uint64_t hits = 0;
  uint64_t misses = 0;  // found absent
  uint64_t fetches = 0;
  uint64_t joined = 0;  // fibers that joined a fetch in flight
  uint64_t builds = 0;
  uint64_t builds_saved = 0;  // another node of the process had it resident
  uint64_t evictions = 0;
  uint64_t waited = 0;  // [ns] idle
  uint64_t fetched_bytes = 0;
  uint64_t largest_resident_bytes = 0;  // of one node, at its end
  uint64_t pinned_bytes = 0;
  uint64_t tally_full = 0;             // times that a batch waited for room in the tally
  uint64_t max_tally_bytes = 0;        // of one node, if its budget is smaller than all bins
  Histogram fetch_delay;               // of objects from other nodes: from the request to the bytes
  Histogram object_wait;               // of fibers: from asking for an object until they go on
  uint64_t hops = 0;                   // links passed by all fetched objects together
  uint64_t processor_ns = 0;           // of real nodes' threads while they ran
  uint64_t longest_turn = 0;           // [ns] of CPU time, of one node
  ActorName failed = ActorName::none;  // why one left before the end; none: all stayed

  void add(const WorkerReport& other);
  /// Fraction of references that found the object resident; 1 without references.
  double hit_rate() const {
    const uint64_t all = hits + misses + joined;
    return all == 0 ? 1 : static_cast<double>(hits) / static_cast<double>(all);
  }
};

class FetchingObjects {
 public:
  /// Adds the part server to the node's actors. Requires: run.objects is not null; all references
  /// outlive this.
  FetchingObjects(const RunSetup& run, const NodeSetup& node, NodeShell& shell,
                  const BuilderMaker& make_builder = make_part_builder, NodeTrace* trace = nullptr);

  ObjectSource& source() { return source_; }
  const PartServer& server() const { return server_; }
  /// Pins these objects as far as the pinned share allows.
  void pin(std::span<const uint32_t> objects) { server_.cache().pin(objects); }
  void add_metrics(Metrics& metrics) const;
  WorkerReport report() const;

 private:
  const NodeId self_;
  HeldObjects store_;
  std::optional<FaultyObjects> faulty_;  // if reads shall fail
  const std::unique_ptr<ObjectBuilder> builder_;
  PartServer server_;
  CachedObjects source_;
};

}  // namespace luxodus
