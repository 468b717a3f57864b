// What a node needs that does not hold all parts of the scene: a store for what it holds for
// others, a cache for itself, and the way to everybody else's. Thread rule: the node's thread.
#pragma once

#include "actors/cast/node/node_setup.hpp"
#include "actors/cast/node/node_shell.hpp"
#include "runtime/fetch/faulty_objects.hpp"
#include "runtime/fetch/part_server.hpp"

namespace luxodus {

/// What the caches of nodes did, for a line to people and for tests.
struct WorkerReport {
  NodeId node;
  uint64_t hits = 0;
  uint64_t misses = 0;  // that found it absent
  uint64_t fetches = 0;
  uint64_t joined = 0;  // fibers that found a fetch under way
  uint64_t builds = 0;
  uint64_t builds_saved = 0;  // another node of the process had it ready
  uint64_t evictions = 0;
  uint64_t waited = 0;  // [ns] with nothing to do
  uint64_t fetched_bytes = 0;
  uint64_t largest_resident_bytes = 0;  // of one node, when it ended
  uint64_t pinned_bytes = 0;
  uint64_t tally_full = 0;       // times that a batch waited for room in the tally
  uint64_t max_tally_bytes = 0;  // of one node, where its budget is less than all bins take
  Histogram fetch_delay;         // of objects that came over links: from the wish to the bytes
  Histogram object_wait;         // of fibers: from asking for an object to going on with it
  uint64_t hops = 0;             // links that fetched objects passed, all together
  uint64_t processor_ns = 0;     // of real nodes' threads while they ran
  uint64_t longest_turn = 0;     // [ns] of processor time, of one node
  ActorName failed = ActorName::none;  // why one left before the end; none: all stayed

  void add(const WorkerReport& other);
  /// Of all references to objects, those that found the object resident; 1 where there was none.
  double hit_rate() const {
    const uint64_t all = hits + misses + joined;
    return all == 0 ? 1 : static_cast<double>(hits) / static_cast<double>(all);
  }
};

class FetchingObjects {
 public:
  /// Adds the part server to the node's actors.
  /// Requires: run.objects is not null; all outlive this.
  FetchingObjects(const RunSetup& run, const NodeSetup& node, NodeShell& shell,
                  const BuilderMaker& make_builder = make_part_builder, NodeTrace* trace = nullptr);

  ObjectSource& source() { return source_; }
  const PartServer& server() const { return server_; }
  /// Keeps these for good, as far as their share of the budget goes.
  void pin(std::span<const uint32_t> objects) { server_.cache().pin(objects); }
  void add_metrics(Metrics& metrics) const;
  WorkerReport report() const;

 private:
  const NodeId self_;
  HeldObjects store_;
  std::optional<FaultyObjects> faulty_;  // where reads shall fail
  const std::unique_ptr<ObjectBuilder> builder_;
  PartServer server_;
  CachedObjects source_;
};

}  // namespace luxodus
