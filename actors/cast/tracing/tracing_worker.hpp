// The actor of a node that works for a coordinator: it asks for batches, gives them to the node's
// LeasedWork, and flushes what that has merged, until the run ends or the coordinator is given up.
// LeasedWork is the node's photon-threads or, if the node coordinates others, a sub-coordinator. If
// a coordinator is lost it joins the next one; what the lost one was told counts as lost. Questions
// without an answer are retried under the same id, and the coordinator's answers are idempotent. If
// totals are sharded, a flush goes to the coordinator once all shards hold their slices. Thread
// rule: the node's thread.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "actors/cast/tally/slice_sender.hpp"
#include "actors/results/run/leased_work.hpp"
#include "runtime/messaging/node_actor.hpp"
#include "runtime/messaging/retry_timer.hpp"
#include "runtime/observe/node_trace.hpp"

namespace luxodus {

struct TracingWorkerConfig {
  NodeId self;
  /// Its possible coordinators: its own first; if that is lost, the first that is reachable. The
  /// last one leads the run. At least one.
  std::vector<Address> coordinators;
  /// Time to the first retry, and more if answers take long: see RetryTimer.
  Nanoseconds answer_patience = seconds(2);
  /// Merged batches wait at least this long, unless there is no more to do.
  Nanoseconds flush_every = seconds(5);
  /// Time until the coordinator is first heard, and afterwards how long it may be unreachable: then
  /// it is given up.
  Nanoseconds start = seconds(60);
  Nanoseconds lost = seconds(30);
  /// How long a coordinator may be unreachable before the next one is joined, if there is one.
  /// Before it was ever heard, half of `start`: a run begins with all its workers.
  Nanoseconds rejoin = seconds(30);
  NodeTrace* trace = nullptr;  // null: no tracing
};

/// How long merged batches wait, if a recent flush took `cost` (packing it here, and waiting for a
/// controller that may be busy with others): so that flushes take at most a fiftieth of the time,
/// but never more than a quarter of the lease time, lest the batches be leased again.
constexpr Nanoseconds flush_interval(Nanoseconds least, Nanoseconds cost, Nanoseconds lease_time) {
  return std::min(std::max(least, 50 * cost), lease_time / 4);
}

/// Sent by a tracer to itself: pack the merged totals, on its fiber.
struct PackFlush {
  Totals* totals;
};

class TracingWorker final
    : public NodeActor<TracingWorker,
                       ControlLane<Accepts<Letter<LeaseGranted>, 16, WhenFull::reject>,
                                   Accepts<Letter<FlushTaken>, 16, WhenFull::reject>,
                                   Accepts<Letter<FlushRefused>, 64, WhenFull::reject>,
                                   Accepts<Letter<LeasesFenced>, 64, WhenFull::reject>,
                                   Accepts<Letter<RoundOpened>, 1, WhenFull::coalesce>,
                                   Accepts<Letter<StateTold>, 4, WhenFull::reject>,
                                   Accepts<Letter<RunEnded>, 64, WhenFull::reject>,
                                   Accepts<Letter<EnterPhase>, 4, WhenFull::reject>,
                                   Accepts<Letter<SliceHeld>, 256, WhenFull::reject>>,
                       DataLane<Accepts<PackFlush, 1, WhenFull::fail>>>,
      public LeasePort {
 public:
  /// Requires: all references outlive this.
  TracingWorker(const TracingWorkerConfig& config, const ShardPlan& shards, Scheduler& scheduler,
                Network& network, Sender& sender);

  /// Requires: called once, before `work` starts; the scheduler has a fiber for it.
  void start(LeasedWork& work);

  // From the coordinator; the end of the run also from neighbours.
  void on(const Letter<LeaseGranted>& granted);
  void on(const Letter<FlushTaken>& taken);
  void on(const Letter<FlushRefused>& refused);
  void on(const Letter<LeasesFenced>& fenced);
  void on(const Letter<RoundOpened>& opened);
  void on(const Letter<StateTold>& told);
  void on(const Letter<RunEnded>& ended);
  void on(const Letter<EnterPhase>& phase);
  // From shards.
  void on(const Letter<SliceHeld>& held);
  void on(const PackFlush& pack);

  void want_leases(size_t count) override;
  void leases_done(std::span<const uint64_t> leases) override;
  bool has_room_for(size_t leases) const override {
    return done_.size() + leases <= limits::leases;
  }
  void lease_failed(uint64_t lease, int64_t batch) override;
  bool give_back(std::span<const uint64_t> leases) override;
  void return_leases() override;
  void want_room() override;
  bool room_to_come() const override { return packing_ || flushing_ || !done_.empty(); }
  size_t flush_bytes() const override { return encoder_->memory_bytes() + slices_.memory_bytes(); }
  void give_up(const Problem& why) override { end(why); }
  void thread_failed(const std::exception_ptr& why) override { fail_with(why); }

  /// Whether the run is over, as this node has heard; or the controller was given up.
  bool over() const { return over_; }
  /// Whether it is over and this node may leave. A node that has heard of the end stays until it is
  /// released, since the message to others may have to pass through it.
  bool ended() const { return ended_ && work_->gone(); }
  /// Tells a neighbour of the run's end, if this node has heard of it.
  void tell_end(NodeId neighbour);
  /// Why the run ended without this node, or could not begin.
  const std::optional<Problem>& fault() const { return fault_; }

  /// Asks for no more, and flushes what is at hand once it is traced: this node is about to leave.
  void drain();
  /// Whether everything at hand has reached the controller.
  bool drained() const;
  /// Tells the coordinator that this node leaves before the end of the run.
  void say_goodbye();

  struct Counters {
    uint64_t leases = 0;
    uint64_t flushes = 0;
    uint64_t flushes_refused = 0;
    uint64_t flush_bytes = 0;
    uint64_t asked_again = 0;
    uint64_t leases_failed = 0;
    uint64_t leases_given_back = 0;
    uint64_t coordinators_left = 0;  // because they were lost
    uint64_t led_by = 0;             // number of the node whose coordinator leads this one
  };
  const Counters& counters() const { return counters_; }
  void add_metrics(Metrics& metrics) const;

 private:
  struct Question {
    MessageId id;
    RetryTimer* timer;  // of its kind
    Message message;
    SharedBytes payload;  // of a flush
    Nanoseconds asked = 0;
    bool left = false;  // the network has taken it
  };

  void ask();
  void flush();
  bool encoder_is_free() const;
  bool rested(Nanoseconds now) const;
  bool pack_all(Totals& totals);
  bool pack_bins(FlushEncoder& encoder, Totals& totals, const BinRange& bins, FlushCounts counts);
  void put_flush();
  void put_when_placed(const MessageId& flush);
  bool hears(Address from);
  Question question(RetryTimer& timer, Message message, SharedBytes payload = {});
  void put(Question& question);
  void retry();
  void ask_now();
  void set_timer();
  void on_timer();
  void begin_round();
  void make_encoders();
  void begin_state(ObjectId state);
  void ask_state(ObjectId state);
  void enter_state();
  void cannot_enter(const Problem& why);
  void forget_flush();
  void flush_when_idle();
  Address coordinator() const { return config_.coordinators[led_by_]; }
  void watch_coordinator(Nanoseconds now);
  bool join_another();
  void take_leave();
  bool leads_still(Address from) const;
  void end(std::optional<Problem> fault);
  void stop_work(std::optional<Problem> fault, bool abandoned);
  void let_go();
  void pass_on();
  SendOutcome tell_neighbour(NodeId neighbour);
  void flush_answered(const MessageId& answered, bool taken);
  Nanoseconds vain_since(uint64_t lease, int64_t batch);

  TracingWorkerConfig config_;
  const Clock& clock_;
  Network& network_;  // for reachability
  SliceSender slices_;
  LeasedWork* work_ = nullptr;
  size_t led_by_ = 0;  // index in config_.coordinators
  /// Coordinators that were left, and have not confirmed it yet: they would keep batches for this
  /// node.
  struct Left {
    Address whom;
    // the message about leaving: newer than all questions, whose answers may still arrive
    MessageId word;
  };
  std::vector<Left> left_;
  bool known_here_ = false;           // the coordinator was heard since it was joined
  std::optional<Question> asking_;    // for leases
  std::optional<Question> flushing_;  // one at a time; sent when all its slices are held
  std::optional<Question> learning_;  // for the description of a state
  RetryTimer lease_timer_, flush_timer_, state_timer_;
  // its batches are leased, but nothing is merged until it is entered
  std::optional<ObjectId> entering_;
  std::vector<uint64_t> done_;  // merged, in no flush yet
  std::vector<uint64_t> packed_leases_;
  std::shared_ptr<FlushEncoder> encoder_;  // shared with the network while it sends
  bool packing_ = false;
  bool room_wanted_ = false;      // the tally is full: flush as soon as possible
  bool flush_due_ = false;        // waits for the network to release the previous flush
  Nanoseconds packing_took_ = 0;  // of the last flush
  Nanoseconds flush_cost_ = 0;    // of the last answered flush
  Nanoseconds lease_time_ = 0;
  Nanoseconds first_done_ = 0;  // when the oldest batch in done_ was merged
  /// Batches whose tries failed, with the lease of the last try, and since when.
  struct InVain {
    uint64_t lease;
    int64_t batch;
    Nanoseconds since;
  };
  std::vector<InVain> in_vain_;
  bool returned_ = false;      // the coordinator knows that all are returned
  bool retries_soon_ = false;  // a timer will retry what has not left
  size_t wanted_ = 0;
  uint32_t round_ = 0;        // of the last grant: a round begins when all before is counted
  bool round_empty_ = false;  // the controller had no batch: flush, and wait for the next round
  // working --hears of the run's end--> over --released, or the controller is lost--> ended
  bool over_ = false;
  bool ended_ = false;
  RunEnded end_word_;                        // as it was received
  std::optional<std::vector<NodeId>> tell_;  // neighbours that still must be told
  bool rumour_ = false;  // a neighbour reports the end, unconfirmed by the controller
  bool draining_ = false;
  std::optional<Problem> fault_;
  bool heard_ = false;  // the controller was heard
  Nanoseconds began_;
  std::optional<Nanoseconds> unreachable_since_;
  Counters counters_;
};

}  // namespace luxodus
