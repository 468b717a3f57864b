// The trace of one node: what its sampled particles did, with times of the node's clock. A part
// that traces holds a pointer, null if tracing is off, and asks wants() first. Spans are
// distinguished by an id: a particle's spans have its own, a fetch's that of its request, so that
// they nest and join as chrome_trace() explains. Thread rule: the node's thread.
#pragma once

#include <string>
#include <vector>

#include "runtime/observe/trace_ring.hpp"

namespace luxodus {

enum class TraceKind : uint32_t {
  particle,  // id: the particle, arg: its batch; from its birth to its end
  wait,      // id: the particle, arg: the object that it waits for
  fetch,     // id: of the request, arg: the object
  build,     // id: of the object, arg: the object; until it is ready
  batch,     // id: the lease, arg: the batch; only of batches with a sampled particle
  flush,     // id: of the flush, arg: its bytes
};
/// Names by number, for chrome_trace().
const std::vector<std::string>& trace_kind_names();

class NodeTrace {
 public:
  /// No particle: for events of a whole batch.
  static constexpr uint64_t nobody = UINT64_MAX;

  NodeTrace(NodeId node, size_t events, uint64_t every, const Clock& clock)
      : node_(node), every_(every), ring_(events, every), clock_(clock) {}

  bool wants(uint64_t particle) const { return particle != nobody && ring_.wants(particle); }
  /// The first sampled particle from `particle` on.
  uint64_t next_wanted(uint64_t particle) const {
    const uint64_t beyond = particle % every_;
    return beyond == 0 ? particle : particle + (every_ - beyond);
  }
  void begin(TraceKind kind, uint64_t id, uint64_t arg) { put(kind, id, arg, TracePhase::begin); }
  void end(TraceKind kind, uint64_t id, uint64_t arg) { put(kind, id, arg, TracePhase::end); }

  NodeId node() const { return node_; }
  const TraceRing& ring() const { return ring_; }

 private:
  void put(TraceKind kind, uint64_t id, uint64_t arg, TracePhase phase) {
    ring_.record({clock_.now(), unique(kind, id), arg, static_cast<uint32_t>(kind), phase});
  }
  /// Numbers of leases and objects may equal those of particles: kind and node make them unique.
  uint64_t unique(TraceKind kind, uint64_t id) const {
    if (kind != TraceKind::batch && kind != TraceKind::build) return id;
    return (static_cast<uint64_t>(kind) + 1) << 60 | uint64_t{node_.value} << 44 | id;
  }

  NodeId node_;
  uint64_t every_;  // not 0
  TraceRing ring_;
  const Clock& clock_;
};

}  // namespace luxodus
