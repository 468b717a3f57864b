#include "actors/cast/coordinator/run_coordinator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Interval of log lines about missing workers.
constexpr Nanoseconds waiting_word = seconds(10);
}  // namespace

RunCoordinator::RunCoordinator(const CoordinatorConfig& config, RunLead lead, Scheduler& scheduler,
                               Network& network, Sender& sender)
    : Coordinator(config, lead.run.scene(),
                  LeaseBook(lead.run.batches(), lead.run.missing(), config.first_lease,
                            config.look_ahead * static_cast<int64_t>(config.workers.size())),
                  scheduler, network, sender),
      run_(lead.run),
      stop_(lead.stop),
      interrupt_(lead.interrupt),
      report_(std::move(lead.report)),
      calls_(lead.calls),
      journal_(lead.journal),
      shard_plan_(lead.shards),
      shards_(lead.shards, lead.run.totals(), clock(), config.lost, sender, address()),
      shows_(lead.display, lead.run, {config.look_every / 2, config.lost}, sender, address()),
      plan_(lead.run.scene()),
      target_(lead.stop.target_batches(lead.run.scene().batch_particles)),
      batches_at_start_(lead.run.traced()),
      began_(clock().now()),
      error_(std::numeric_limits<double>::quiet_NaN()) {}

void RunCoordinator::start() {
  Coordinator::start();
  began_ = clock().now();
  next_word_ = began_ + waiting_word;
  if (!nothing_left()) return;
  begun_ = done_before_ = true;
  note_book();
  end_run(book_.committed() >= target_ ? StopReason::particles : StopReason::error);
}

/// Whether an earlier incarnation has counted all that was asked for. Then no worker is awaited:
/// those that have heard of the end are gone.
bool RunCoordinator::nothing_left() const {
  if (book_.committed() >= target_) return true;
  if (!stop_.relative_error || book_.committed() == 0 || !book_.missing().empty()) return false;
  if (run_.plan().round_end(book_.committed() - 1) != book_.committed()) return false;
  return stop_.error_is_reached(Readout(run_.scene(), run_.totals()).worst_relative_error());
}

// ---- arrival and loss of workers ---------------------------------------------------------------

void RunCoordinator::life_ended(NodeId worker, Incarnation life) {
  shards_.end_life(worker, life);
  shows_.end_life(worker);
}

void RunCoordinator::begin() {
  begun_ = true;
  began_ = clock().now();
  log_info("run=begun workers={}", config_.workers.size());
  note_book();
  open_round();
}

void RunCoordinator::await_workers(Nanoseconds now) {
  if (const auto taken = network_.taken_elsewhere()) {
    // The refusal names the other run's results, and the node adds it to this.
    fault_ = problem(fmt::format("the run did not begin, since its workers are not free: let the "
                                 "run that {} works for end first, or give this one other workers",
                                 name_of(*taken)),
                     ProblemKind::refused);
    return end_run(StopReason::workers_lost);
  }
  if (interrupt_.load()) {
    closing_ = true;
    return end_run(StopReason::interrupted);
  }
  if (now - began_ < config_.start) {
    if (now < next_word_) return;
    next_word_ = now + waiting_word;
    log_info("run=waiting text=\"{}\"", missing_workers());
    return;
  }
  fault_ = problem(fmt::format("the run did not begin: after {:g} s (start_s) {}",
                               seconds_in(config_.start), missing_workers()),
                   ProblemKind::lost_peer);
  end_run(StopReason::workers_lost);
}

/// Names the missing workers, and why as far as this node can know: for its own links.
std::string RunCoordinator::missing_workers() const {
  const std::vector<NodeId> own = network_.neighbours();
  std::string text;
  for (const auto& [worker, peer] : peers_) {
    if (peer.here || !peer.expected) continue;
    const std::string refusal = network_.refusal_of(worker);
    const bool linked = std::count(own.begin(), own.end(), worker) > 0;
    text += fmt::format("{}{} has not come ({})", text.empty() ? "" : "; ", name_of(worker),
                        !refusal.empty() ? refusal
                        : linked         ? "there is no link to it: see its log"
                                         : "it has no link to this node: see its log");
  }
  return text;
}

void RunCoordinator::workers_watched() {
  // With shards, an unreachable worker is awaited until it is lost: then the run has failed.
  if (!begun_ || over_ || adding() || reading_ || !all_gone() || shards_.others() > 0) return;
  if (!closing_) return end_run(StopReason::workers_lost);
  end_run(interrupt_.load() ? StopReason::interrupted : StopReason::time);
}

/// Whether no tracing worker is left: all are lost, or unreachable when the run is ending anyway. A
/// node that leads others and has returned its leases has none left. A worker led by another node
/// may still join when that node is lost, as long as it is reachable.
bool RunCoordinator::all_gone() const {
  return std::all_of(peers_.begin(), peers_.end(), [&](const auto& entry) {
    const auto& [worker, peer] = entry;
    const bool leads = levels_below(worker) > 0;
    if (peer.here && (peer.traces() || !leads)) return closing_ && peer.unreachable_since;
    return peer.expected || leads || peer.unreachable_since;
  });
}

/// A shard's totals are nowhere else, so losing its worker ends the run.
void RunCoordinator::lose_shard(NodeId worker, const char* how) {
  if (!begun_ || !shards_.owns(worker)) return;
  fail(
      fmt::format("{} {}, and with it a shard of the totals, so that this run has no result: "
                  "begin anew, with fewer shards or other nodes in [tally] shards",
                  name_of(worker), how));
}

void RunCoordinator::fail(const std::string& what) {
  if (over_) return;
  fault_ = problem(what, ProblemKind::lost_peer);
  log_error("run=failed text=\"{}\"", what);
  end_run(StopReason::workers_lost);
}

/// Batches that no worker can trace are lost, and the run fails with them: leased batches are
/// completed, and no more are leased, since the next ones would need the same objects.
void RunCoordinator::lose_batches() {
  if (!book_.has_given_back()) return;
  std::vector<NodeId> here;
  for (const auto& [worker, peer] : peers_)
    if (peer.traces()) here.push_back(worker);
  const int64_t lost = book_.lose_what_all_gave_back(here);
  if (lost == 0) return;
  counters_.batches_lost += static_cast<uint64_t>(lost);
  log_error(
      "run=lost batches={} particles={} text=\"nobody who is left can have the objects that these "
      "need: the run ends without them\"",
      lost, lost * run_.scene().batch_particles);
  if (!closing_) book_.close();
  closing_ = true;
}

void RunCoordinator::add_metrics(Metrics& metrics) const {
  Coordinator::add_metrics(metrics);
  metrics.add_counter({"flushes_not_kept", "", "Flushes that the journal could not take.", ""},
                      counters_.flushes_not_kept);
  metrics.add_gauge({"round", "", "Rounds begun.", ""}, counters_.round);
  if (shards_.others() == 0) return;
  const ShardControl::Counters& s = shards_.counters();
  metrics.add_counter({"shard_decisions", "", "Decisions to be told to shards.", ""}, s.decisions);
  metrics.add_counter({"gathers", "", "Times that shards' totals were brought here.", ""},
                      s.gathers);
  metrics.add_counter({"gathered", "bytes", "Bytes of totals that shards told.", ""},
                      s.gathered_bytes);
}

// ---- rounds ----------------------------------------------------------------------------------

void RunCoordinator::open_round() {
  const int64_t planned =
      stop_.next_wait(book_.committed(), run_.scene().batch_particles, run_.plan());
  book_.open_until(std::max(planned, book_.lent_end()));  // an earlier run may lack some
  ++counters_.round;
  offer_batches();
}

/// Ends the round when all of it is counted, and starts a reading of the totals if one is due. With
/// shards the totals are first gathered here, after every decision is acknowledged. Meanwhile no
/// flush is counted, so that they are consistent.
void RunCoordinator::look_at_totals() {
  if (!begun_ || over_) return;
  if (shards_.fault()) return fail(*shards_.fault());
  if (adding() || reading_ || shards_.gathering()) return;
  const bool round_done = book_.round_done();
  if (!round_done && !run_.pause_is_due() && !shows_.wanted()) return go_on_counting();
  if (shards_.others() > 0 && !gathered_) {
    if (counting() || !shards_.settled()) return;  // called again when they are
    return shards_.gather([this] {
      gathered_ = true;
      look_at_totals();
    });
  }
  read_totals(round_done);
}

/// Not within a turn: millions of bins, files and pictures take longer.
void RunCoordinator::read_totals(bool round_done) {
  reading_ = true;
  packing_ = shows_.begin_pack();
  if (run_.pause_is_due() || packing_) run_.resume(book_.lent_end(), book_.missing());
  reads_round_ = round_done;
  read_seconds_ = shown_seconds();
  const auto read = [this] {
    try {
      run_.pause_if_due();
      if (packing_) shows_.pack(run_, read_seconds_);
      if (reads_round_) read_error_ = Readout(run_.scene(), run_.totals()).worst_relative_error();
    } catch (...) {
      reading_failed_ = std::current_exception();
    }
  };
  calls_.begin(read, own_task([this, round_done] { totals_read(round_done); }));
}

void RunCoordinator::totals_read(bool round_done) {
  reading_ = false;
  gathered_ = false;
  if (reading_failed_) std::rethrow_exception(std::exchange(reading_failed_, nullptr));
  if (std::exchange(packing_, false)) shows_.packed(over_, reason_);
  if (round_done && !over_) {
    error_ = read_error_;
    end_round();
  }
  over_ ? show_last_totals() : go_on_counting();
}

void RunCoordinator::end_round() {
  if (book_.lost() > 0) return end_run(StopReason::objects_lost);
  const bool interrupted = closing_ && interrupt_.load();
  const RunProgress here{book_.committed(), error_, interrupted, closing_ && !interrupted};
  const auto reason = stop_.reason_to_stop(here, run_.scene().batch_particles);
  reason ? end_run(*reason) : open_round();
}

void RunCoordinator::end_run(StopReason reason) {
  reason_ = reason;
  end_work();
  calls_.finish();
  if (journal_ != nullptr) journal_->finish();
  next_word_ = over_since_ + waiting_word;
  run_.resume(book_.lent_end(), book_.missing());
  tell_end();
}

RunEnded RunCoordinator::end_word() const {
  return {round(), fault_ ? fault_->what.substr(0, limits::text_bytes) : ""};
}

/// Whether the end of the run waits until the journal holds all work. Otherwise, if this node
/// crashed, that work would have to be traced again by workers that have been told to end. After
/// `lost` it no longer waits for the disk.
bool RunCoordinator::awaits_journal() const {
  return journal_ != nullptr && !journal_->is_whole() && !fault_ && !interrupt_.load() &&
         over_for() < config_.lost;
}

void RunCoordinator::let_go_when_told() {
  if (letting_go_) return;
  if (awaits_journal() || !show_is_settled() || (!all_know_end() && over_for() < config_.lost))
    return;
  if (!letting_go_) let_go();
}

void RunCoordinator::wait_for_farewells(Nanoseconds now) {
  tidy_journal();
  tell_end();
  let_go_when_told();
  if (letting_go_ || now < next_word_) return;
  next_word_ = now + waiting_word;
  if (awaits_journal()) {
    log_info(
        "run=over text=\"its workers stay until the journal has what it lacks: that takes {:g} s "
        "(lost_s) at most\"",
        seconds_in(config_.lost));
    return;
  }
  log_info("run=over text=\"{} must hear of it, or be lost: that takes {:g} s (lost_s) at most\"",
           who_lacks_end(), seconds_in(config_.lost));
}

// ---- timers ----------------------------------------------------------------------------------

void RunCoordinator::look_at_work(Nanoseconds now) {
  if (!begun_) return await_workers(now);
  report_(progress());
  shards_.look();
  fence(book_.fence_late(now), "late");
  lose_batches();
  note_book();
  tidy_journal();
  const double passed = seconds_in(now - began_);
  if (!closing_ && (interrupt_.load() || stop_.time_is_up(passed))) {
    closing_ = true;
    book_.close();
  }
  look_at_totals();
}

Progress RunCoordinator::progress() const {
  const double passed = seconds_in(clock().now() - began_);
  return progress_of(stop_, run_.scene().batch_particles, batches_at_start_, book_.committed(),
                     passed, error_);
}

// ---- messages --------------------------------------------------------------------------------

void RunCoordinator::on(const Letter<FlushSettled>& settled) {
  shards_.on(settled);
  look_at_totals();
}

void RunCoordinator::on(const Letter<TotalsTold>& told) {
  shards_.on(told);
  look_at_totals();
}

LeaseBook::Rank RunCoordinator::rank_of(NodeId worker) {
  if (worker.value >= config_.group_ranks.size()) return {};
  return [this, &ranks = config_.group_ranks[worker.value]](int64_t batch) {
    return ranks[group_of(batch)];
  };
}

size_t RunCoordinator::group_of(int64_t batch) {
  while (static_cast<int64_t>(groups_.size()) <= batch)
    groups_.push_back(static_cast<uint32_t>(plan_.next().group));
  return groups_[static_cast<size_t>(batch)];
}

// ---- flushes ---------------------------------------------------------------------------------

BinRange RunCoordinator::bins() const {
  return shard_plan_.range(0, scene_.layout.totals());
}

/// Readers may look at the totals between two flushes; while shards are gathered or a snapshot is
/// made, flushes wait.
bool RunCoordinator::holds_back(size_t) {
  if (shards_.gathering() || reading_) return true;
  return shards_.others() > 0 && !over_ && (run_.pause_is_due() || shows_.wanted());
}

Result<void> RunCoordinator::may_count(const Letter<Flush>& letter) const {
  if (letter.body.slice_hashes.size() == shards_.others()) return {};
  return problem("shards lack their slices of it");
}

/// Journals a flush before it is acknowledged, so that the run survives this node. If that fails
/// the run continues without, since its totals are right. Returns false if this node is ending.
bool RunCoordinator::keep(const Letter<Flush>& letter) {
  if (journal_ == nullptr) return true;
  const std::span<const int64_t> batches = book_.batches_of(letter.body.leases);
  Kept kept;
  const KeepFlush keep{batches, letter.payload.bytes(), &kept};
  bool goes_on = journal_->send(keep) == Offered::taken;
  while (goes_on && !kept.done)
    goes_on = scheduler().fibers().wait(kept.waiting, "journal") != Wake::cancelled;
  if (!goes_on) {
    journal_->finish();
    return false;
  }
  if (kept.outcome) return true;
  ++counters_.flushes_not_kept;
  log_error("journal=failed flushes={} text=\"{}: should this node crash, they are traced again\"",
            counters_.flushes_not_kept, kept.outcome.problem().text());
  return true;
}

void RunCoordinator::counted(const Letter<Flush>& letter, std::span<const int64_t>) {
  gathered_ = false;
  shards_.take(letter.id, letter.body.slice_hashes);
}

/// Runs between flushes, when the totals hold everything journaled. No flush is counted until it is
/// done.
void RunCoordinator::tidy_journal() {
  if (journal_ == nullptr || adding() || counting() || reading_) return;
  if (!journal_->tidying_is_due()) return;
  run_.resume(book_.lent_end(), book_.missing());
  const TidyJournal tidy{[this] {
    reading_ = false;
    go_on_counting();
    look_soon();
  }};
  reading_ = journal_->offer(tidy) == Offered::taken;
}

}  // namespace luxodus
