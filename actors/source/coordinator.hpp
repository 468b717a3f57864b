// The actor that leads a run on nodes: lends batches, takes flushes whole or refuses them, decides
// when a round and the run are over. It holds the run's totals and traces nothing itself. A run
// begins with all its workers or not at all; once begun it goes on as long as one is left. Where
// workers hold shards of the totals, it tells these of every decision (shard_control.hpp), brings
// their totals here before a round ends or somebody looks, and ends when one of them is lost.
// Thread rule: its node's thread.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "actors/run/local_run.hpp"
#include "actors/showing/show_control.hpp"
#include "actors/source/journal_actor.hpp"
#include "actors/source/lease_book.hpp"
#include "actors/tally/shard_control.hpp"
#include "runtime/messaging/node_actor.hpp"

namespace luxodus {

struct CoordinatorConfig {
  NodeId self;
  std::vector<NodeId> workers;
  /// By worker, its rank of each source group, the least the most liked: near what the node holds.
  /// Empty: all batches are lent in their order.
  std::vector<std::vector<uint32_t>> group_ranks;
  /// Batches before their turn that may be lent so, for each worker. Of eight, one is of the eighth
  /// of the work that a node of eight prefers; ten times as many are what a run that is stopped has
  /// yet to trace.
  int64_t look_ahead = 8;
  std::vector<std::string> names;   // of nodes, by number, for people; empty: they have none
  ShardPlan shards;                 // of the totals
  BlockingCalls* calls = nullptr;   // by which totals are read; never null
  JournalActor* journal = nullptr;  // of what is counted; null: none is kept
  std::optional<NodeId> display;    // where the run is shown; nothing: nowhere
  /// Until every worker has been heard of; else the run does not begin.
  Nanoseconds start = seconds(60);
  /// A worker that no way leads to for so long is lost: long against a link that is made anew.
  Nanoseconds lost = seconds(30);
  uint64_t first_lease = 1;  // random, where a controller may be started again
  /// A batch that is not back by then is lent to another: long against the slowest batch.
  Nanoseconds lease_time = seconds(120);
  Nanoseconds look_every = milliseconds(250);  // at time, interrupt and lost workers
  uint32_t max_leases = 64;                    // for one question
};

/// Of a coordinator to itself: this flush is to be counted, on its fiber.
struct CountFlush {
  Letter<Flush> letter;
};

class Coordinator final
    : public NodeActor<Coordinator,
                       ControlLane<Accepts<Letter<RequestLease>, 4096, WhenFull::reject>,
                                   Accepts<Letter<LeasesFenced>, 1024, WhenFull::reject>,
                                   Accepts<Letter<Flush>, 1024, WhenFull::reject>,
                                   Accepts<Letter<FlushSettled>, 256, WhenFull::reject>,
                                   Accepts<Letter<TotalsTold>, 256, WhenFull::reject>,
                                   Accepts<Letter<ShowTotals>, 8, WhenFull::reject>,
                                   Accepts<Letter<FluxSaved>, 8, WhenFull::reject>>,
                       DataLane<Accepts<CountFlush, 2048, WhenFull::reject>>> {
 public:
  /// Goes on from the batches that `run` holds. All that is referred to must outlive it.
  Coordinator(const CoordinatorConfig& config, LocalRun& run, const StopRule& stop,
              const std::atomic<bool>& interrupt, std::function<void(const Progress&)> report,
              Scheduler& scheduler, Network& network, Sender& sender);

  ~Coordinator() override { config_.calls->finish(); }

  /// Waits for the workers from now on. Requires: the scheduler has a fiber for it.
  void start();

  // Of workers, in whatever order.
  void on(const Letter<RequestLease>& request);
  void on(const Letter<LeasesFenced>& given_back);
  void on(Letter<Flush>&& flush);
  // Of shards.
  void on(const Letter<FlushSettled>& settled);
  void on(const Letter<TotalsTold>& told);
  // Of the display.
  void on(const Letter<ShowTotals>& show);
  void on(const Letter<FluxSaved>& saved);
  void on(CountFlush&& count);

  /// Ends the run, with this error: all that take part in it are told.
  void fail(const std::string& what);

  /// The display never will write the results: ends the run, or leaves them unwritten.
  void lose_display(const std::string& why);

  /// All is over, every worker has heard so, or is lost, and has been let go. The flux is on a
  /// disk, where there is a display.
  bool ended() const;
  /// How long ago the run was over.
  Nanoseconds over_for() const { return over_ ? clock_.now() - over_since_ : 0; }
  StopReason reason() const { return reason_; }
  /// The run is over, and no display has written its results, as far as is known here.
  bool lost_display() const { return lost_display_; }
  /// From the moment when all workers were here to that when all was counted; 0 before it.
  Nanoseconds took() const { return over_ ? over_since_ - began_ : 0; }
  /// A flush is being kept, or the totals hold a part of it.
  bool adding() const { return adding_; }
  /// Why the run could not begin, or has no results.
  const std::optional<Problem>& fault() const { return fault_; }

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
  const ShardControl::Counters& shard_counters() const { return shards_.counters(); }
  const ShowControl::Counters& show_counters() const { return shows_.counters(); }
  void add_metrics(Metrics& metrics) const;

 private:
  /// What is known of a worker.
  struct Peer {
    bool here = false;  // it was heard of, and has not been lost since
    Incarnation life;   // of which leases stand
    std::vector<Incarnation> former;
    std::optional<Nanoseconds> unreachable_since;
    std::optional<Nanoseconds> told;  // when it last said that it has heard of the end
    bool left = false;                // it said that it leaves before the end
    bool gone = false;                // it was let go
  };

  bool meet(Address worker, Incarnation life);
  void begin();
  void await_workers(Nanoseconds now);
  void watch_workers(Nanoseconds now);
  bool all_gone() const;
  std::string name_of(NodeId node) const;
  std::string missing_workers() const;
  void fence(const std::vector<Lease>& leases, const char* why);
  void offer_again();
  void lose_batches();
  void open_round();
  void look();
  void wait_for_farewells(Nanoseconds now);
  void set_timer();
  bool nothing_left() const;
  uint32_t max_to_lend() const;
  LeaseGranted grant_of(const LentBatches& lent) const;
  LeaseBook::Rank rank_of(NodeId worker);
  size_t group_of(int64_t batch);
  bool holds_back() const;
  void go_on_counting();
  void answer_flush(const Letter<Flush>& letter, const std::string& why);
  std::string count_flush(const Letter<Flush>& letter);
  bool take_turns();
  bool keep(const Letter<Flush>& letter);
  void tidy_journal();
  void look_at_totals();
  void show_last_totals();
  double shown_seconds() const;
  bool show_is_settled();
  void look_soon();
  void lose_shard(NodeId worker, const char* how);
  void read_totals(bool round_done);
  void totals_read(bool round_done);
  void end_round();
  void end_run(StopReason reason);
  void tell_end();
  void tell_untold();
  bool knows_end(NodeId worker, const Peer& peer) const;
  RunEnded end_word() const;
  void answer_with_end(const Letter<RequestLease>& request);
  void let_go_when_told();
  void let_go();
  std::string who_lacks_end() const;
  bool awaits_journal() const;
  void note_book();
  uint32_t round() const { return static_cast<uint32_t>(counters_.round); }
  Progress progress() const;
  SendOutcome send(NodeId worker, const MessageId& id, const Message& message);

  CoordinatorConfig config_;
  LocalRun& run_;
  StopRule stop_;
  const std::atomic<bool>& interrupt_;
  std::function<void(const Progress&)> report_;
  const Clock& clock_;
  Network& network_;  // who is within reach
  LeaseBook book_;
  ShardControl shards_;
  ShowControl shows_;
  BatchPlan plan_;
  std::vector<uint32_t> groups_;  // of batches, as far as asked; where groups are ranked
  int64_t target_;
  int64_t batches_at_start_;
  Nanoseconds began_;
  double error_;
  std::map<NodeId, Peer> peers_;  // all workers
  bool done_before_ = false;      // an earlier life has counted all that was asked for
  bool begun_ = false;
  Nanoseconds next_word_ = 0;  // of whom it waits for
  std::optional<Problem> fault_;
  bool closing_ = false;  // no lease beyond the last: time is up or somebody interrupts
  bool over_ = false;
  Nanoseconds over_since_ = 0;
  std::vector<NodeId> untold_;  // of the end: the network had no room; in the order of waiting
  bool telling_ = false;        // a timer is set for tell_untold()
  bool letting_go_ = false;
  StopReason reason_ = StopReason::particles;
  /// The last answer to each worker's question of each kind, by the question's sequence: a question
  /// that comes twice is answered alike.
  struct Answered {
    MessageId question;
    Message answer;
  };
  std::map<NodeId, Answered> last_grant_, last_flush_;
  /// Flushes not counted yet. They are counted on the actor's fiber, in steps: a million bins take
  /// a second, in which beats must go on.
  std::vector<MessageId> uncounted_;
  WaitList held_back_;    // the fiber, while shards tell their totals or a snapshot is made
  bool reading_ = false;  // somebody reads the totals: nothing is added to them
  bool packing_ = false;  // for the display
  bool lost_display_ = false;
  double read_error_ = 0;  // what was read last
  std::exception_ptr reading_failed_;
  bool counting_ = false;    // a flush
  bool adding_ = false;      // a flush is being kept, or the totals hold a part of it
  bool looks_soon_ = false;  // a timer is set for look_at_totals()
  bool gathered_ = false;    // the totals are those of all that is counted, shards included
  Counters counters_;
};

}  // namespace luxodus
