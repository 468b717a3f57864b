// A shard of the totals, at the worker that owns it. It receives slices of flushes from all
// workers, validates them, holds them separately, and acknowledges them. The controller then
// decides about each flush: a slice of a counted flush is added, once; one of a refused flush is
// dropped. At the end of a round the controller asks for the totals, piece by piece; what it has
// received is removed here.
//
// Lost, late and duplicate messages:
// - A slice: the worker retries until the shard acknowledges it. A duplicate is acknowledged again;
//   one of a flush that was decided meanwhile is old, and gets no answer.
// - A decision: the controller retries until it is acknowledged. It sends those about one node one
//   at a time, so a decision older than the last is acknowledged without effect.
// - A question for totals names its piece. The last piece is kept until the next one is asked for,
//   which confirms its receipt.
// Each incarnation of a worker has at most one slice here: the next one gets no answer, and so is
// sent again, until the previous one is decided. This bounds the memory by one flush per worker.
// When an incarnation ends, the controller decides about all its remaining slices in one decision.
// Slow work (reading and adding a slice) is done on the actor's fiber. Thread rule: the node's
// thread.
#pragma once

#include <map>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

#include "actors/cast/tally/flush_codec.hpp"
#include "actors/cast/tally/shard_plan.hpp"
#include "runtime/core/result.hpp"
#include "runtime/messaging/node_actor.hpp"

namespace luxodus {

struct TallyShardConfig {
  NodeId self;
  NodeId controller;
  BinRange bins;
};

/// Sent by a shard to itself: take the next step with this incarnation's slice.
struct WorkOnSlice {
  NodeId node;
  Incarnation life;
};

class TallyShard final
    : public NodeActor<TallyShard,
                       ControlLane<Accepts<Letter<FlushSlice>, 1024, WhenFull::reject>,
                                   Accepts<Letter<FlushDecided>, 64, WhenFull::reject>,
                                   Accepts<Letter<AskTotals>, 16, WhenFull::reject>>,
                       DataLane<Accepts<WorkOnSlice, 2048, WhenFull::reject>>> {
 public:
  /// Requires: `layout` and `sender` outlive this; the scheduler has a fiber for it.
  TallyShard(const TallyShardConfig& config, const TallyLayout& layout, int groups,
             Scheduler& scheduler, Sender& sender);

  void on(Letter<FlushSlice>&& slice);
  void on(const Letter<FlushDecided>& decision);
  void on(const Letter<AskTotals>& question);
  void on(const WorkOnSlice& work);

  struct Counters {
    uint64_t slices = 0;  // added
    uint64_t slices_dropped = 0;
    uint64_t slice_bytes = 0;   // received
    uint64_t held = 0;          // at present
    uint64_t totals_bytes = 0;  // in memory
  };
  const Counters& counters() const { return counters_; }
  const Totals& totals() const { return totals_; }
  void add_metrics(Metrics& metrics) const;

 private:
  /// States of a slice: read -> held -> added, or dropped from either of the first two.
  struct Slice {
    MessageId flush;
    Address from;
    uint64_t hash = 0;
    Payload payload;                 // until it is read
    std::optional<FlushGain> gain;   // set once it is held
    std::optional<MessageId> taken;  // the decision that it was counted
    bool dropped = false;
  };
  using Life = std::pair<NodeId, Incarnation>;

  void hold(Slice& slice);
  void read(Slice& slice);
  Result<void> take_in(Slice& slice);
  void add(Slice& slice);
  void forget(Slice& slice);
  bool work_on(const Slice& slice);
  void settle(const MessageId& decision, bool whole);
  bool take_turns();
  uint64_t decided(const Life& life) const;
  void pack_next_piece();

  const TallyShardConfig config_;
  Totals totals_;
  /// Memory of slices: a finished one leaves its memory to the next.
  std::pmr::unsynchronized_pool_resource memory_;
  std::pmr::map<Life, std::shared_ptr<Slice>> slices_{&memory_};
  std::map<Life, uint64_t> decided_;  // sequence number of the last decided flush
  FlushReader reader_;
  FlushEncoder encoder_;  // of pieces of the totals
  TotalsTold told_;       // the last piece
  std::shared_ptr<std::vector<std::byte>> told_bytes_;
  Counters counters_;
};

}  // namespace luxodus
