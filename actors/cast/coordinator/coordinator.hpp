// The actor that leads those who trace, or those who lead them: lends batches, takes flushes whole
// or refuses them, fences what is late or lost, and sees to it that all have heard of the end
// before any is let go. Where its batches come from and where its totals go is said by those who
// derive from it: RunCoordinator leads a run; SubCoordinator leads in another coordinator's stead,
// and behaves towards that one as a tracer does; StateCoordinator leads work on a scene that
// changes. It traces nothing itself.
// Thread rule: its node's thread.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "actors/cast/coordinator/lease_book.hpp"
#include "actors/cast/tally/flush_codec.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/result.hpp"
#include "runtime/messaging/node_actor.hpp"
#include "runtime/messaging/retry_timer.hpp"
#include "runtime/observe/metrics.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// What is below a node in the tree of coordinators.
struct NodesBelow {
  uint32_t tracers = 1;  // who trace, itself included
  uint32_t levels = 0;   // of coordinators, itself included
};

struct CoordinatorConfig {
  NodeId self;
  std::vector<NodeId> workers;  // whom it leads
  /// Who may come, beside them, when another coordinator is lost.
  std::vector<NodeId> orphans;
  /// Of every node of the run, by number; empty: all trace.
  std::vector<NodesBelow> below;
  /// By worker, its rank of each source group, the least the most liked: near what the node holds.
  /// Empty: all batches are lent in their order.
  std::vector<std::vector<uint32_t>> group_ranks;
  /// Batches before their turn that may be lent so, for each worker. Of eight, one is of the eighth
  /// of the work that a node of eight prefers; ten times as many are what a run that is stopped has
  /// yet to trace.
  int64_t look_ahead = 8;
  std::vector<std::string> names;  // of nodes, by number, for people; empty: they have none
  /// Until every worker has been heard of; else the run does not begin. Who leads in another's
  /// stead waits for half of it: whom it leads may have joined another meanwhile.
  Nanoseconds start = seconds(60);
  /// A worker that no way leads to for so long is lost: long against a link that is made anew.
  Nanoseconds lost = seconds(30);
  ObjectId state = {};       // of the scene, named in every lease
  uint64_t first_lease = 1;  // random, where a controller may be started again
  /// A batch that is not back by then is lent to another: long against the slowest batch. A node
  /// that leads others has four times as long for each of its levels, from its last flush on.
  Nanoseconds lease_time = seconds(120);
  Nanoseconds look_every = milliseconds(250);  // at time, interrupt and lost workers
  uint32_t max_leases = 64;                    // for one question of a node that traces
};

/// Of a coordinator to itself: this flush is to be counted, on its fiber.
struct CountFlush {
  Letter<Flush> letter;
};

class Coordinator
    : public NodeActor<Coordinator,
                       ControlLane<Accepts<Letter<RequestLease>, 4096, WhenFull::reject>,
                                   Accepts<Letter<LeasesFenced>, 1024, WhenFull::reject>,
                                   Accepts<Letter<Flush>, 1024, WhenFull::reject>,
                                   Accepts<Letter<EnterPhase>, 256, WhenFull::reject>,
                                   Accepts<Letter<AskState>, 256, WhenFull::reject>,
                                   Accepts<Letter<FlushSettled>, 256, WhenFull::reject>,
                                   Accepts<Letter<TotalsTold>, 256, WhenFull::reject>,
                                   Accepts<Letter<ShowTotals>, 8, WhenFull::reject>,
                                   Accepts<Letter<FluxSaved>, 8, WhenFull::reject>>,
                       DataLane<Accepts<CountFlush, 2048, WhenFull::reject>>> {
 public:
  // Of workers, in whatever order.
  void on(const Letter<RequestLease>& request);
  void on(const Letter<LeasesFenced>& given_back);
  void on(Letter<Flush>&& flush);
  void on(CountFlush&& count);
  void on(const Letter<EnterPhase>& leave);
  virtual void on(const Letter<AskState>&) {}  // who leads a run has one state, which all know
  // Of shards and of the display, which only who leads a run has.
  virtual void on(const Letter<FlushSettled>&) {}
  virtual void on(const Letter<TotalsTold>&) {}
  virtual void on(const Letter<ShowTotals>&) {}
  virtual void on(const Letter<FluxSaved>&) {}

  /// All is over, every worker has heard so, or is lost, and has been let go.
  bool ended() const;
  /// For how long a worker, at most, is taken to know of the end that has said so.
  Nanoseconds word_is_fresh() const;
  /// How long ago the run was over.
  Nanoseconds over_for() const { return over_ ? clock_.now() - over_since_ : 0; }
  /// A flush is being kept, or the totals hold a part of it.
  bool adding() const { return adding_; }

  struct Counters {
    uint64_t leases = 0;
    uint64_t fenced = 0;
    uint64_t workers_lost = 0;
    uint64_t batches_lost = 0;  // nobody who is here could trace them
    uint64_t flushes_taken = 0;
    uint64_t flushes_refused = 0;
    uint64_t flushes_not_kept = 0;  // by the journal
    uint64_t flush_bytes = 0;
    uint64_t round = 0;
    uint64_t batches = 0;  // counted, those of an earlier run included
    uint64_t leases_out = 0;
    uint64_t particles = 0;  // of counted batches
  };
  const Counters& counters() const { return counters_; }
  virtual void add_metrics(Metrics& metrics) const;

 protected:
  /// All that is referred to must outlive it.
  Coordinator(const CoordinatorConfig& config, const CompiledScene& scene, LeaseBook book,
              Scheduler& scheduler, Network& network, Sender& sender);

  /// Waits for the workers from now on. Requires: the scheduler has a fiber for it.
  void start();

  /// What is known of a worker.
  struct Peer {
    explicit Peer(const RetryTimer& timer) : telling(timer) {}

    bool expected = true;  // else it may come when another coordinator is lost
    bool here = false;     // it was heard of, and has not been lost since
    Incarnation life;      // of which leases stand
    std::vector<Incarnation> former;
    std::optional<Nanoseconds> unreachable_since;
    RetryTimer telling;               // it of the end
    std::optional<Nanoseconds> told;  // when it last said that it has heard so
    bool left = false;                // it has joined another coordinator, or ended
    bool idle = false;                // it has returned its leases: nobody below it traces
    bool gone = false;                // it was let go

    bool traces() const { return here && !left && !idle; }
  };

  // ---- what those who derive from it say ------------------------------------------------------

  /// With every look, until it is over.
  virtual void look_at_work(Nanoseconds now) = 0;
  /// A flush has been counted or refused.
  virtual void look_at_totals() = 0;
  virtual void all_are_here() = 0;
  /// A worker is here that was not, or has been found again.
  virtual void worker_came(NodeId) {}
  /// A worker has another life than before, or is lost.
  virtual void life_ended(NodeId, Incarnation) {}
  virtual void worker_gone(NodeId, const char* /*how*/) {}
  virtual ObjectId state() const { return config_.state; }
  /// Batches were lent, or there are none.
  virtual void lent() {}
  virtual LeaseBook::Rank rank_of(NodeId) { return {}; }

  /// Into which flushes are counted, and which of the bins these hold.
  virtual Totals& totals() = 0;
  virtual BinRange bins() const { return {0, scene_.layout.totals()}; }
  /// No flush of so many leases may be counted now.
  virtual bool holds_back(size_t leases) = 0;
  /// Whether this flush may be counted.
  virtual Result<void> may_count(const Letter<Flush>&) const { return {}; }
  /// Before it is counted. False: this node ends.
  virtual bool keep(const Letter<Flush>&) { return true; }
  /// It is; of these batches.
  virtual void counted(const Letter<Flush>& letter, std::span<const int64_t> batches) = 0;
  virtual void refused(const MessageId&) {}

  virtual RunEnded end_word() const = 0;
  /// Nobody may hear of the end yet.
  virtual bool keeps_end_to_itself() const { return false; }
  /// Nobody who is out of reach is waited for.
  virtual bool hurries() const { return false; }
  /// The others that are expected hear of the end too, though they were never here.
  virtual bool tells_all() const { return false; }
  virtual void wait_for_farewells(Nanoseconds now) = 0;
  /// First: without room they would be told at the next look.
  virtual void before_end_is_told() {}
  /// A worker says that it has heard of the end.
  virtual void farewell_heard() {}
  /// All workers have been looked after.
  virtual void workers_watched() {}

  // ---- what it does for them ------------------------------------------------------------------

  /// Fences leases that were taken out of the book, and offers their batches to others.
  void fence(const std::vector<Lease>& leases, const char* why);
  void tell_fenced(const std::vector<Lease>& leases);
  void offer_batches();
  void go_on_counting();
  void look_soon();
  /// Lets others have their turn. A node that is to end goes on: what is begun is whole in the end.
  bool take_turns();
  void note_book();

  /// Nothing is lent or counted any more, and all are told.
  void end_work();
  void tell_end();
  /// It is another one than was told.
  void tell_end_anew();
  bool all_know_end() const;
  void let_go();
  std::string who_lacks_end() const;

  uint32_t tracers_of(NodeId worker) const;
  uint32_t levels_below(NodeId worker) const;
  std::string name_of(NodeId node) const;
  SendOutcome send(NodeId worker, const MessageId& id, const Message& message);
  uint32_t round() const { return static_cast<uint32_t>(counters_.round); }
  bool counting() const { return counting_; }
  const Clock& clock() const { return clock_; }

  const CoordinatorConfig config_;
  const CompiledScene& scene_;
  Network& network_;  // who is within reach
  LeaseBook book_;
  std::map<NodeId, Peer> peers_;  // all workers
  bool begun_ = false;
  bool over_ = false;
  Nanoseconds over_since_ = 0;
  bool letting_go_ = false;
  Counters counters_;

 private:
  bool meet(Address worker, Incarnation life);
  void watch_workers(Nanoseconds now);
  static bool is_older(const MessageId& question, const MessageId& last);
  LentBatches lend(NodeId worker, uint32_t batches);
  Nanoseconds span_of(NodeId worker) const;
  uint32_t max_to_lend(NodeId worker) const;
  LeaseGranted grant_of(NodeId worker, const LentBatches& lent) const;
  void answer_flush(const Letter<Flush>& letter, const Result<void>& counted);
  Result<void> count_flush(const Letter<Flush>& letter);
  void look();
  void set_timer();
  void tell_untold();
  bool knows_end(NodeId worker, const Peer& peer) const;
  bool is_told(const Peer& peer) const;
  Nanoseconds is_fresh_for(const Peer& peer) const;
  RetryTimer end_timer(NodeId worker) const;
  bool is_lost(const Peer& peer) const;
  void answer_with_end(const Letter<RequestLease>& request);

  const Clock& clock_;
  uint32_t tracers_ = 0;        // below those whom it leads
  std::vector<NodeId> untold_;  // of the end: the network had no room; in the order of waiting
  bool telling_ = false;        // a timer is set for tell_untold()
  /// The last answer to each worker's question of each kind, by the question's sequence: a question
  /// that comes twice is answered alike.
  struct Answered {
    MessageId question;
    Message answer;
    RetryTimer offer{milliseconds(250), seconds(30)};  // of more, where there were no batches
  };
  std::map<NodeId, Answered> last_grant_, last_flush_;
  NodeId last_offered_;  // to whom batches were
  /// Flushes not counted yet. They are counted on the actor's fiber, in steps: a million bins take
  /// a second, in which beats must go on.
  std::vector<MessageId> uncounted_;
  FlushReader reader_;
  Hasher payload_hash_;      // of the flush that is being counted
  WaitList held_back_;       // the fiber, while nothing may be counted
  bool counting_ = false;    // a flush
  bool adding_ = false;      // a flush is being kept, or the totals hold a part of it
  bool looks_soon_ = false;  // a timer is set for look_at_totals()
};

}  // namespace luxodus
