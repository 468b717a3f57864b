// The actor that journals what a coordinator counts, so that a run survives its node. Only it uses
// the FlushKeeper, whose calls wait for a disk and run off the node's thread. While a flush is
// being journaled its leases cannot be fenced; it is counted when it is durable. Thread rule: the
// node's thread.
#pragma once

#include <exception>

#include "actors/cast/journal/flush_keeper.hpp"
#include "runtime/actor/actor.hpp"
#include "runtime/actor/blocking_calls.hpp"

namespace luxodus {

/// Outcome of a flush given to the journal; owned by the giver.
struct Kept {
  bool done = false;
  Result<void> outcome;
  WaitList waiting;  // woken when it is done
};

/// Keep this flush. Its data must live until `kept->done`, or JournalActor::finish().
struct KeepFlush {
  std::span<const int64_t> batches;
  std::span<const std::byte> flush;
  Kept* kept = nullptr;
};

/// Tidy up: the totals hold everything kept, and nothing is added to them until `done` is called.
struct TidyJournal {
  Task done;
};

class JournalActor final : public Actor<JournalActor, ControlLane<>,
                                        DataLane<Accepts<KeepFlush, 1, WhenFull::wait>,
                                                 Accepts<TidyJournal, 1, WhenFull::reject>>> {
 public:
  /// Requires: all references outlive this; start(), with a fiber for it.
  JournalActor(Scheduler& scheduler, FlushKeeper& keeper, BlockingCalls& calls)
      : Actor(scheduler, "journal"), keeper_(keeper), calls_(calls), whole_(keeper.is_whole()) {}

  ~JournalActor() override { calls_.finish(); }

  void on(const KeepFlush& keep);
  void on(const TidyJournal& tidy);

  /// Whether everything counted outlives the node: see FlushKeeper::is_whole.
  bool is_whole() const { return whole_ && !busy(); }
  /// Whether a message waits, or a call is in progress.
  bool busy() const { return working_ || waiting() > 0; }
  bool tidying_is_due() const { return !busy() && keeper_.rest_is_due(); }
  /// Waits until no call is in progress, for shutdown.
  void finish() { calls_.finish(); }

 private:
  bool make_call(std::function<void()> call);

  FlushKeeper& keeper_;
  BlockingCalls& calls_;
  bool whole_;  // the keeper's answer after its last call
  bool working_ = false;
  bool returned_ = false;      // the call has returned
  std::exception_ptr thrown_;  // by the call
  WaitList returning_;         // this actor's fiber, while a call is in progress
};

}  // namespace luxodus
