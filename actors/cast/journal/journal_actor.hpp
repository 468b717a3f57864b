// The actor that keeps what a coordinator counts, so that a run survives its node. It alone touches
// the keeper of flushes, and has its calls, which wait for a disk, made off the node's thread.
// While a flush is being kept its leases cannot be fenced; it is counted when it is durable. Thread
// rule: the node's thread.
#pragma once

#include <exception>

#include "actors/cast/journal/flush_keeper.hpp"
#include "runtime/actor/actor.hpp"
#include "runtime/actor/blocking_calls.hpp"

namespace luxodus {

/// What has become of a flush that was given to the journal. Of whoever gives it.
struct Kept {
  bool done = false;
  Result<void> outcome;
  WaitList waiting;  // woken when it is done
};

/// Keep this flush. What it refers to lives until `kept->done`, or JournalActor::finish().
struct KeepFlush {
  std::span<const int64_t> batches;
  std::span<const std::byte> flush;
  Kept* kept = nullptr;
};

/// Tidy up: the totals hold all that was kept, and nothing is added to them until `done` is called.
struct TidyJournal {
  Task done;
};

class JournalActor final : public Actor<JournalActor, ControlLane<>,
                                        DataLane<Accepts<KeepFlush, 1, WhenFull::wait>,
                                                 Accepts<TidyJournal, 1, WhenFull::reject>>> {
 public:
  /// Requires: all outlive this; start(), with a fiber for it.
  JournalActor(Scheduler& scheduler, FlushKeeper& keeper, BlockingCalls& calls)
      : Actor(scheduler, "journal"), keeper_(keeper), calls_(calls), whole_(keeper.is_whole()) {}

  ~JournalActor() override { calls_.finish(); }

  void on(const KeepFlush& keep);
  void on(const TidyJournal& tidy);

  /// Whether all that was counted outlives the node: see FlushKeeper::is_whole.
  bool is_whole() const { return whole_ && !busy(); }
  /// A message waits, or a call is under way.
  bool busy() const { return working_ || waiting() > 0; }
  bool tidying_is_due() const { return !busy() && keeper_.rest_is_due(); }
  /// Waits until no call is under way: its node ends.
  void finish() { calls_.finish(); }

 private:
  bool make_call(std::function<void()> call);

  FlushKeeper& keeper_;
  BlockingCalls& calls_;
  bool whole_;  // as the keeper said when it was last called
  bool working_ = false;
  bool returned_ = false;      // the call that was made
  std::exception_ptr thrown_;  // by it
  WaitList returning_;         // this actor's fiber, while a call is under way
};

}  // namespace luxodus
