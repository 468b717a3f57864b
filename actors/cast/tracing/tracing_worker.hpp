// The actor of a node that works for a coordinator: asks it for batches, gives them to those who
// trace them, and sends what these have merged, until the run ends or the coordinator is given up.
// Those are the node's photon-threads or, where the node coordinates others, these (LeasedWork). A
// coordinator that is lost is left for the next one: what was told to it is as good as lost. What
// gets no answer is asked again under the same id; the coordinator answers a repeated question as
// it did before. Where totals lie in shards, a flush goes to the coordinator when all shards hold
// theirs. Thread rule: the node's thread.
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
  /// By whom it may be led: first its own coordinator; where that is lost, the first of them that
  /// there is a way to. Last the one that leads the run. At least one.
  std::vector<Address> coordinators;
  /// Then a question is asked again, and later where answers take long: see RetryTimer.
  Nanoseconds answer_patience = seconds(2);
  /// Merged batches rest here for so long at least, unless there is no more to do.
  Nanoseconds flush_every = seconds(5);
  /// Until the coordinator is heard for the first time, and then without a way to it: after that it
  /// is given up.
  Nanoseconds start = seconds(60);
  Nanoseconds lost = seconds(30);
  /// Without a way to a coordinator, until the next one is joined, where there is one. Who has not
  /// heard of its coordinator yet waits for half of `start`: a run begins with all its workers.
  Nanoseconds rejoin = seconds(30);
  NodeTrace* trace = nullptr;  // null: nothing is traced
};

/// How long merged batches rest, when a flush lately took `cost` (packing it here, and waiting for
/// the answer of a controller that may be busy with others'): so long that flushes take a fiftieth
/// of the time, but never more than a quarter of the leases' time, lest they be lent again.
constexpr Nanoseconds flush_interval(Nanoseconds least, Nanoseconds cost, Nanoseconds lease_time) {
  return std::min(std::max(least, 50 * cost), lease_time / 4);
}

/// Of a tracer to itself: what is merged is to be packed, on its fiber.
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
  /// Requires: all that is referred to outlives it.
  TracingWorker(const TracingWorkerConfig& config, const ShardPlan& shards, Scheduler& scheduler,
                Network& network, Sender& sender);

  /// Requires: once, before `work` starts; the scheduler has a fiber for it.
  void start(LeasedWork& work);

  // Of the coordinator; the end of the run, of neighbours as well.
  void on(const Letter<LeaseGranted>& granted);
  void on(const Letter<FlushTaken>& taken);
  void on(const Letter<FlushRefused>& refused);
  void on(const Letter<LeasesFenced>& fenced);
  void on(const Letter<RoundOpened>& opened);
  void on(const Letter<StateTold>& told);
  void on(const Letter<RunEnded>& ended);
  void on(const Letter<EnterPhase>& phase);
  // Of shards.
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
  /// let go, since others' word of it may have to pass through it.
  bool ended() const { return ended_ && work_->gone(); }
  /// Passes the word of the run's end on to a neighbour, if this node has heard it.
  void tell_end(NodeId neighbour);
  /// Why the run ended without this node, or could not begin.
  const std::optional<Problem>& fault() const { return fault_; }

  /// Asks for no more, and flushes what is at hand once it is traced: this node is to leave.
  void drain();
  /// Whether all that was at hand is with the controller.
  bool drained() const;
  /// Tells the coordinator that this node leaves before the run has ended.
  void say_goodbye();

  struct Counters {
    uint64_t leases = 0;
    uint64_t flushes = 0;
    uint64_t flushes_refused = 0;
    uint64_t flush_bytes = 0;
    uint64_t asked_again = 0;
    uint64_t leases_failed = 0;
    uint64_t leases_given_back = 0;
    uint64_t coordinators_left = 0;  // that were lost
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
  Network& network_;  // who is within reach
  SliceSender slices_;
  LeasedWork* work_ = nullptr;
  size_t led_by_ = 0;  // of config_.coordinators
  /// Coordinators that were left, and have yet to answer that they heard so: they would keep
  /// batches for this node.
  struct Left {
    Address whom;
    MessageId word;  // that it was left: newer than all questions, whose answers may still come
  };
  std::vector<Left> left_;
  bool known_here_ = false;           // the coordinator was heard since it was joined
  std::optional<Question> asking_;    // for leases
  std::optional<Question> flushing_;  // one at a time; put when all its slices are held
  std::optional<Question> learning_;  // what a state of the scene is made from
  RetryTimer lease_timer_, flush_timer_, state_timer_;
  std::optional<ObjectId> entering_;  // batches of it are lent, and nothing is merged until it is
  std::vector<uint64_t> done_;        // merged, in no flush yet
  std::vector<uint64_t> packed_leases_;
  std::shared_ptr<FlushEncoder> encoder_;  // shared with the network while it sends
  bool packing_ = false;
  bool room_wanted_ = false;      // the tally is full: flush as soon as that can be
  bool flush_due_ = false;        // it waits for the network to let go of the last one
  Nanoseconds packing_took_ = 0;  // of the last flush
  Nanoseconds flush_cost_ = 0;    // of the last one that was answered
  Nanoseconds lease_time_ = 0;
  Nanoseconds first_done_ = 0;  // when the oldest of them was merged
  /// Batches that were traced in vain, under the lease of their last try, and since when.
  struct InVain {
    uint64_t lease;
    int64_t batch;
    Nanoseconds since;
  };
  std::vector<InVain> in_vain_;
  bool returned_ = false;      // the coordinator has heard that all are returned
  bool retries_soon_ = false;  // a timer puts again what has not left
  size_t wanted_ = 0;
  uint32_t round_ = 0;        // of the last grant: a round begins when all before is counted
  bool round_empty_ = false;  // the controller had none: flush, and wait for the next round
  // working --the run's end is heard of--> over --let go, or the controller is lost--> ended
  bool over_ = false;
  bool ended_ = false;
  RunEnded end_word_;                        // as it was heard
  std::optional<std::vector<NodeId>> tell_;  // neighbours that it has yet to be passed on to
  bool rumour_ = false;  // a neighbour says that the run is over, of which nothing is known here
  bool draining_ = false;
  std::optional<Problem> fault_;
  bool heard_ = false;  // of the controller
  Nanoseconds began_;
  std::optional<Nanoseconds> unreachable_since_;
  Counters counters_;
};

}  // namespace luxodus
