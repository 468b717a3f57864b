// The coordinator of a run: its stopping rule defines the batches, round by round; what is counted
// is journaled, and becomes the run's result. A run begins with all its workers or not at all;
// afterwards it continues as long as one is left. If workers hold shards of the totals, it sends
// them every decision (shard_control.hpp), gathers their totals before a round ends or a reader
// looks, and ends when one of them is lost. Thread rule: its node's thread.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include "actors/cast/coordinator/coordinator.hpp"
#include "actors/cast/display/show_control.hpp"
#include "actors/cast/journal/journal_actor.hpp"
#include "actors/cast/tally/shard_control.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

struct RunLead {
  LocalRun& run;
  const StopRule& stop;
  const std::atomic<bool>& interrupt;
  std::function<void(const Progress&)> report;
  ShardPlan shards;                 // of the totals
  BlockingCalls& calls;             // reads the totals off the node's thread
  JournalActor* journal = nullptr;  // null: no journal
  std::optional<NodeId> display;    // node that shows the run; nothing: none
};

class RunCoordinator final : public Coordinator {
 public:
  /// Continues from the batches that the run holds. Requires: all references outlive this.
  RunCoordinator(const CoordinatorConfig& config, RunLead lead, Scheduler& scheduler,
                 Network& network, Sender& sender);

  ~RunCoordinator() override { calls_.finish(); }

  /// Begins to wait for the workers. Requires: the scheduler has a fiber for it.
  void start();

  void on(const Letter<FlushSettled>& settled) override;
  void on(const Letter<TotalsTold>& told) override;
  void on(const Letter<ShowTotals>& show) override;
  void on(const Letter<FluxSaved>& saved) override;

  /// Ends the run with this error, and tells all workers.
  void fail(const std::string& what);
  /// The display will never write the results: ends the run, or leaves them unwritten.
  void lose_display(const std::string& why);

  StopReason reason() const { return reason_; }
  /// Whether the run is over and no display has written its results, as far as is known here.
  bool lost_display() const { return lost_display_; }
  /// Time from the arrival of the last worker to the end of counting; 0 before that.
  Nanoseconds took() const { return over_ ? over_since_ - began_ : 0; }
  /// Why the run could not begin, or has no results.
  const std::optional<Problem>& fault() const { return fault_; }
  const ShardControl::Counters& shard_counters() const { return shards_.counters(); }
  void add_metrics(Metrics& metrics) const override;

 private:
  void look_at_work(Nanoseconds now) override;
  void look_at_totals() override;
  void all_are_here() override { begin(); }
  void life_ended(NodeId worker, Incarnation life) override;
  void worker_gone(NodeId worker, const char* how) override { lose_shard(worker, how); }
  void workers_watched() override;
  LeaseBook::Rank rank_of(NodeId worker) override;
  Totals& totals() override { return run_.totals(); }
  BinRange bins() const override;
  bool holds_back(size_t leases) override;
  Result<void> may_count(const Letter<Flush>& letter) const override;
  bool keep(const Letter<Flush>& letter) override;
  void counted(const Letter<Flush>& letter, std::span<const int64_t> batches) override;
  void refused(const MessageId& flush) override { shards_.refuse(flush); }
  RunEnded end_word() const override;
  bool keeps_end_to_itself() const override { return awaits_journal(); }
  bool hurries() const override { return interrupt_.load(); }
  bool tells_all() const override { return done_before_; }
  void wait_for_farewells(Nanoseconds now) override;
  void farewell_heard() override { let_go_when_told(); }
  void before_end_is_told() override { shows_.tell_end(end_word(), clock().now()); }

  void begin();
  void await_workers(Nanoseconds now);
  bool all_gone() const;
  std::string missing_workers() const;
  void lose_batches();
  void open_round();
  bool nothing_left() const;
  size_t group_of(int64_t batch);
  void tidy_journal();
  void meet_display(Incarnation life);
  void show_last_totals();
  double shown_seconds() const;
  bool show_is_settled();
  void lose_shard(NodeId worker, const char* how);
  void read_totals(bool round_done);
  void totals_read(bool round_done);
  void end_round();
  void end_run(StopReason reason);
  void let_go_when_told();
  bool awaits_journal() const;
  Progress progress() const;

  LocalRun& run_;
  const StopRule stop_;
  const std::atomic<bool>& interrupt_;
  const std::function<void(const Progress&)> report_;
  BlockingCalls& calls_;
  JournalActor* const journal_;
  const ShardPlan shard_plan_;
  ShardControl shards_;
  ShowControl shows_;
  BatchPlan plan_;
  std::vector<uint32_t> groups_;  // of batches, computed on demand; only if groups are ranked
  int64_t target_;
  int64_t batches_at_start_;
  Nanoseconds began_;
  double error_;
  bool done_before_ = false;   // an earlier incarnation has counted all that was asked for
  Nanoseconds next_word_ = 0;  // next log line about missing workers
  std::optional<Problem> fault_;
  bool closing_ = false;  // time is up or the run was interrupted: no further leases
  StopReason reason_ = StopReason::particles;
  bool reading_ = false;  // the totals are being read: nothing is added to them
  bool packing_ = false;  // for the display
  bool lost_display_ = false;
  std::optional<Incarnation> display_life_;
  double read_error_ = 0;  // error in the last reading
  std::exception_ptr reading_failed_;
  bool reads_round_ = false;  // whether the reading computes the round's error
  double read_seconds_ = 0;
  bool gathered_ = false;  // the totals include all shards' counts
};

}  // namespace luxodus
