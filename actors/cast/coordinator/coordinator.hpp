// The actor that leads tracing nodes, or nodes that lead them: it leases batches, counts each flush
// whole or refuses it, fences leases that are late or lost, and makes sure that all workers have
// heard of the end before it releases any. Derived classes decide where batches come from and where
// totals go: RunCoordinator leads a run; SubCoordinator leads on behalf of another coordinator,
// towards which it behaves as a tracer; StateCoordinator leads work on a scene that changes. It
// traces nothing itself. Thread rule: its node's thread.
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

/// The subtree of a node in the tree of coordinators.
struct NodesBelow {
  uint32_t tracers = 1;  // tracing nodes, including itself
  uint32_t levels = 0;   // of coordinators, including itself
};

struct CoordinatorConfig {
  NodeId self;
  std::vector<NodeId> workers;  // that it leads
  /// Further workers that may join when another coordinator is lost.
  std::vector<NodeId> orphans;
  /// By number, for every node of the run; empty: all nodes trace.
  std::vector<NodesBelow> below;
  /// By worker, its rank of each source group; the lowest rank is preferred: near to what the node
  /// holds. Empty: batches are leased in order.
  std::vector<std::vector<uint32_t>> group_ranks;
  /// How far before their turn preferred batches may be leased, for each worker. Among eight
  /// batches there is one of the eighth of the work that a node of eight prefers. All skipped
  /// batches must still be traced when a run is stopped, so ten times as many would delay its end.
  int64_t look_ahead = 8;
  std::vector<std::string> names;  // of nodes, by number, for messages; empty: none
  /// Time until every worker must have been heard; otherwise the run does not begin. A
  /// sub-coordinator waits for half of it: its workers may have joined another meanwhile.
  Nanoseconds start = seconds(60);
  /// A worker that has been unreachable for this long is lost: long against the repair of a link.
  Nanoseconds lost = seconds(30);
  ObjectId state = {};       // of the scene, named in every lease
  uint64_t first_lease = 1;  // random if a controller may be restarted
  /// A batch that is not back by then is leased to another node: long against the slowest batch. A
  /// node that leads others has four times as long for each of its levels, counted from its last
  /// flush.
  Nanoseconds lease_time = seconds(120);
  Nanoseconds look_every = milliseconds(250);  // checks time, interrupt and lost workers
  uint32_t max_leases = 64;                    // per request of a tracing node
};

/// Sent by a coordinator to itself: count this flush, on its fiber.
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
  // From workers, in any order.
  void on(const Letter<RequestLease>& request);
  void on(const Letter<LeasesFenced>& given_back);
  void on(Letter<Flush>&& flush);
  void on(CountFlush&& count);
  void on(const Letter<EnterPhase>& leave);
  virtual void on(const Letter<AskState>&) {}  // a run has one state, which all know
  // From shards and the display, which only a run's coordinator has.
  virtual void on(const Letter<FlushSettled>&) {}
  virtual void on(const Letter<TotalsTold>&) {}
  virtual void on(const Letter<ShowTotals>&) {}
  virtual void on(const Letter<FluxSaved>&) {}

  /// Whether everything is over and every worker has heard so or is lost, and has been released.
  bool ended() const;
  /// How long, at most, a worker's answer that it has heard of the end counts.
  Nanoseconds word_is_fresh() const;
  /// Time since the run was over.
  Nanoseconds over_for() const { return over_ ? clock_.now() - over_since_ : 0; }
  /// Whether a flush is being journaled, or is partly in the totals.
  bool adding() const { return adding_; }

  struct Counters {
    uint64_t leases = 0;
    uint64_t fenced = 0;
    uint64_t workers_lost = 0;
    uint64_t batches_lost = 0;  // no present worker could trace them
    uint64_t flushes_taken = 0;
    uint64_t flushes_refused = 0;
    uint64_t flushes_not_kept = 0;  // by the journal
    uint64_t flush_bytes = 0;
    uint64_t round = 0;
    uint64_t batches = 0;  // counted, including those of an earlier run
    uint64_t leases_out = 0;
    uint64_t particles = 0;  // in counted batches
  };
  const Counters& counters() const { return counters_; }
  virtual void add_metrics(Metrics& metrics) const;

 protected:
  /// Requires: all references outlive this.
  Coordinator(const CoordinatorConfig& config, const CompiledScene& scene, LeaseBook book,
              Scheduler& scheduler, Network& network, Sender& sender);

  /// Begins to wait for the workers. Requires: the scheduler has a fiber for it.
  void start();

  /// State of a worker.
  struct Peer {
    explicit Peer(const RetryTimer& timer) : telling(timer) {}

    bool expected = true;  // otherwise it may join when another coordinator is lost
    bool here = false;     // it was heard, and has not been lost since
    Incarnation life;      // whose leases are valid
    std::vector<Incarnation> former;
    std::optional<Nanoseconds> unreachable_since;
    RetryTimer telling;               // retries of telling it the end
    std::optional<Nanoseconds> told;  // when it last confirmed the end
    bool left = false;                // it has joined another coordinator, or ended
    bool idle = false;                // it has returned its leases: no node below it traces
    bool gone = false;                // it was released

    bool traces() const { return here && !left && !idle; }
  };

  // ---- hooks of derived classes ---------------------------------------------------------------

  /// Called at every look until the end.
  virtual void look_at_work(Nanoseconds now) = 0;
  /// Called after a flush was counted or refused.
  virtual void look_at_totals() = 0;
  virtual void all_are_here() = 0;
  /// A worker has appeared, or has been found again.
  virtual void worker_came(NodeId) {}
  /// A worker has restarted or is lost.
  virtual void life_ended(NodeId, Incarnation) {}
  virtual void worker_gone(NodeId, const char* /*how*/) {}
  virtual ObjectId state() const { return config_.state; }
  /// Called after a request for leases was answered.
  virtual void lent() {}
  virtual LeaseBook::Rank rank_of(NodeId) { return {}; }

  /// The totals that count flushes, and the range of bins that they hold.
  virtual Totals& totals() = 0;
  virtual BinRange bins() const { return {0, scene_.layout.totals()}; }
  /// Whether a flush of this many leases has to wait before it is counted.
  virtual bool holds_back(size_t leases) = 0;
  /// Whether this flush may be counted.
  virtual Result<void> may_count(const Letter<Flush>&) const { return {}; }
  /// Called before a flush is counted. False: this node is ending.
  virtual bool keep(const Letter<Flush>&) { return true; }
  /// Called after a flush of these batches was counted.
  virtual void counted(const Letter<Flush>& letter, std::span<const int64_t> batches) = 0;
  virtual void refused(const MessageId&) {}

  virtual RunEnded end_word() const = 0;
  /// Whether workers must not yet hear of the end.
  virtual bool keeps_end_to_itself() const { return false; }
  /// Whether the end waits for no unreachable worker.
  virtual bool hurries() const { return false; }
  /// Whether expected workers that never appeared are told of the end, too.
  virtual bool tells_all() const { return false; }
  virtual void wait_for_farewells(Nanoseconds now) = 0;
  /// Called before the end is told: later, these messages might find no room until the next look.
  virtual void before_end_is_told() {}
  /// A worker confirms that it has heard of the end.
  virtual void farewell_heard() {}
  /// Called after all workers have been checked.
  virtual void workers_watched() {}

  // ---- services for derived classes -----------------------------------------------------------

  /// Fences leases that were removed from the book, and offers their batches to others.
  void fence(const std::vector<Lease>& leases, const char* why);
  void tell_fenced(const std::vector<Lease>& leases);
  void offer_batches();
  void go_on_counting();
  void look_soon();
  /// Yields; always true. A node that is ending still completes what has begun.
  bool take_turns();
  void note_book();

  /// Stops leasing and counting; tell_end() may follow.
  void end_work();
  void tell_end();
  /// The end differs from the one that was told.
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
  Network& network_;  // for reachability
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
  uint32_t tracers_ = 0;  // of all its workers
  // workers to tell of the end: the network had no room; in order of waiting
  std::vector<NodeId> untold_;
  bool telling_ = false;  // a timer is set for tell_untold()
  /// The last answer to each worker's question of each kind: a repeated question gets the same
  /// answer.
  struct Answered {
    MessageId question;
    Message answer;
    // of more batches, after an answer without any
    RetryTimer offer{milliseconds(250), seconds(30)};
  };
  std::map<NodeId, Answered> last_grant_, last_flush_;
  NodeId last_offered_;  // the worker to which batches were offered last
  /// Flushes not counted yet. They are counted on the actor's fiber, in steps: a million bins take
  /// a second, during which heartbeats must go on.
  std::vector<MessageId> uncounted_;
  FlushReader reader_;
  Hasher payload_hash_;      // of the flush that is being counted
  WaitList held_back_;       // the fiber, while counting is held back
  bool counting_ = false;    // a flush is being counted
  bool adding_ = false;      // a flush is being journaled, or is partly in the totals
  bool looks_soon_ = false;  // a timer is set for look_at_totals()
};

}  // namespace luxodus
