// A ring buffer of the last trace events, for ui.perfetto.dev: 32-byte records, always on for
// particles whose id is a multiple of the sampling interval, so that a repeated run gives the same
// trace. Recording allocates nothing and overwrites the oldest event. Spans of one request id join
// across nodes and hosts. Thread rule: written by one node; read on its thread, or after it has
// stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/core/ids.hpp"

namespace luxodus {

enum class TracePhase : uint32_t {
  moment,  // a point on the node's track
  begin,   // of a span, which its id identifies
  end,
};

struct TraceEvent {
  Nanoseconds at = 0;
  uint64_t id = 0;   // the request, or the particle
  uint64_t arg = 0;  // meaning depends on the kind
  uint32_t kind = 0;
  TracePhase phase = TracePhase::moment;
};
static_assert(sizeof(TraceEvent) == 32);

class TraceRing {
 public:
  /// Keeps the last `events`. Samples particles with id % every == 0; none if `every` is 0.
  TraceRing(size_t events, uint64_t every) : events_(events), every_(every) {}

  bool wants(uint64_t particle) const { return every_ != 0 && particle % every_ == 0; }

  void record(const TraceEvent& event) {
    if (events_.empty()) return;
    events_[next_] = event;
    next_ = next_ + 1 == events_.size() ? 0 : next_ + 1;
    ++recorded_;
  }

  uint64_t recorded() const { return recorded_; }
  /// The events in the ring, the oldest first.
  std::vector<TraceEvent> kept() const;

 private:
  std::vector<TraceEvent> events_;
  uint64_t every_;
  size_t next_ = 0;
  uint64_t recorded_ = 0;
};

/// One node's part of a trace.
struct TraceTrack {
  NodeId node;
  std::vector<TraceEvent> events;
};

/// Chrome's trace format (JSON), one track per node; `kinds` names the kinds, by number.
std::string chrome_trace(const std::vector<TraceTrack>& tracks,
                         const std::vector<std::string>& kinds);

}  // namespace luxodus
