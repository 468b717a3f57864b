// A shard of the totals, at the worker that owns it. Slices of flushes arrive from all workers, are
// checked and held apart, and answered when they are held. The controller then says what has become
// of each flush: a slice of one that was taken is added, once; one of a flush that was refused is
// dropped. At the end of a round the controller asks for the totals, piece by piece; what it has
// got is no longer here.
//
// What if a message is lost, late, or comes twice?
// - A slice: the worker sends it until it is told that the slice is held. One that comes again is
//   answered again; one of a flush that was decided meanwhile is old, and gets no answer.
// - A decision: the controller repeats it until it is answered. Of one node it sends them one by
//   one, each when the one before was answered; so what is older than the last is answered, and
//   nothing done.
// - A question for totals: it names the piece. The last piece is kept until the next one is asked
//   for, which says that it has come.
// A life of a worker has one slice here at most: the next one gets no answer, so is sent again,
// until the one before is decided. That bounds the memory, by one flush of each worker. When a life
// ends the controller decides about all that was left of it, in one decision. What takes long, to
// read a slice and to add it, is done on the actor's fiber. Thread rule: the node's thread.
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

/// Of a shard to itself: the next step of this life's slice is due.
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
  /// Requires: `layout` and `sender` outlive it; the scheduler has a fiber for it.
  TallyShard(const TallyShardConfig& config, const TallyLayout& layout, int groups,
             Scheduler& scheduler, Sender& sender);

  void on(Letter<FlushSlice>&& slice);
  void on(const Letter<FlushDecided>& decision);
  void on(const Letter<AskTotals>& question);
  void on(const WorkOnSlice& work);

  struct Counters {
    uint64_t slices = 0;  // added
    uint64_t slices_dropped = 0;
    uint64_t slice_bytes = 0;   // that came
    uint64_t held = 0;          // now
    uint64_t totals_bytes = 0;  // in memory
  };
  const Counters& counters() const { return counters_; }
  const Totals& totals() const { return totals_; }
  void add_metrics(Metrics& metrics) const;

 private:
  /// A slice's way: read -> held -> added, or dropped from either of the first two.
  struct Slice {
    MessageId flush;
    Address from;
    uint64_t hash = 0;
    Payload payload;                 // until it is read
    std::optional<FlushGain> gain;   // from then on: it is held
    std::optional<MessageId> taken;  // the decision that says so
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
  /// Of slices: one that is done with leaves it to the next.
  std::pmr::unsynchronized_pool_resource memory_;
  std::pmr::map<Life, std::shared_ptr<Slice>> slices_{&memory_};
  std::map<Life, uint64_t> decided_;  // by life, the sequence of the last flush decided about
  FlushReader reader_;
  FlushEncoder encoder_;  // of pieces of the totals
  TotalsTold told_;       // the last piece
  std::shared_ptr<std::vector<std::byte>> told_bytes_;
  Counters counters_;
};

}  // namespace luxodus
