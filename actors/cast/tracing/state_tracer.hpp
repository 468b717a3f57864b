// A node's work on a scene that changes: batches of the state that is entered, all of which is in
// memory. One photon-thread, one portion per turn; it never waits for an object. The number of
// leases at hand follows from how long a batch takes. Entering a state allocates. Thread rule: the
// node's thread.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "actors/results/run/leased_work.hpp"
#include "actors/results/run/scene_state.hpp"
#include "runtime/actor/scheduler.hpp"
#include "runtime/observe/metrics.hpp"

namespace luxodus {

class StateTracer final : public LeasedWork {
 public:
  /// Until a state is entered, totals belong to `first`. A turn traces at most `portion` particles.
  /// Requires: all references outlive this; portion >= 1.
  StateTracer(const CompiledScene& first, StateMaker& maker, int64_t portion, Scheduler& scheduler,
              LeasePort& port, TracerMaker make_tracer = make_batch_tracer);

  /// Starts its fiber.
  void start();

  bool is_in(ObjectId state) const override { return tracing_ && tracing_->id == state; }
  bool knows(ObjectId state) const override {
    return is_in(state) || (learnt_ && learnt_->id == state);
  }
  Result<void> learn(ObjectId state, std::span<const std::byte> bytes) override;
  void leave_state() override;
  void enter(ObjectId state) override;

  void add(uint64_t lease, int64_t batch) override { leases_.push_back({lease, batch}); }
  void drop(std::span<const uint64_t> leases) override;
  void drop_all() override;
  bool forget_merged() override;
  void give_back_all() override;
  void look_again() override;
  Totals& give_totals() override;
  bool may_give() const override { return !merges_; }
  const Totals& totals() const override { return *totals_[0]; }
  size_t at_hand() const override { return leases_.size() + (open_ ? 1 : 0); }
  void end(const std::string& why) override;

  struct Counters {
    uint64_t batches = 0;
    uint64_t states = 0;  // entered
  };
  const Counters& counters() const { return counters_; }
  /// Counters of the workers of all states.
  BatchWorker::Counters done() const;
  void add_metrics(Metrics& metrics) const;

 private:
  struct PendingBatch {
    uint64_t lease;
    int64_t batch;
  };
  struct LearntState {
    ObjectId id;
    uint64_t seed = 0;
    std::shared_ptr<const TracedState> state;
  };

  void trace_until_the_end();
  bool trace_portion();
  bool open_next();
  void close();
  bool merge();
  void ask_for_more();

  StateMaker& maker_;
  const int64_t portion_;
  Scheduler& scheduler_;
  LeasePort& port_;
  const TracerMaker make_tracer_;
  std::optional<LearntState> learnt_;           // the last one
  std::optional<LearntState> tracing_;          // the one entered
  std::shared_ptr<const TracedState> counted_;  // to which the totals belong
  std::shared_ptr<BatchWorker> worker_;         // of the one entered
  BatchWorker::Counters done_before_;           // by previous ones
  std::shared_ptr<Totals> totals_[2];           // one is filled while the other is emptied
  size_t merging_ = 0;
  std::deque<PendingBatch> leases_;   // not begun, the oldest first
  std::optional<PendingBatch> open_;  // in work
  bool merges_ = false;  // the batch is being merged: totals are neither given away nor forgotten
  Nanoseconds opened_ = 0;
  Nanoseconds batch_takes_ = 0;  // recently
  WaitList work_;                // the fiber, while there is nothing to do
  bool ending_ = false;
  Counters counters_;
};

}  // namespace luxodus
