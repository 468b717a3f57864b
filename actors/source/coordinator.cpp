#include "actors/source/coordinator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/core/check.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Between lines about who is waited for.
constexpr Nanoseconds waiting_word = seconds(10);
/// Looks, at each of which all are told of the end: an answer is as fresh as two of three.
constexpr int heard_lately = 3;
/// Late leases may follow each other closely; what is looked at is more than they.
constexpr Nanoseconds least_between_looks = milliseconds(20);
/// Until what found no room in the network is said again.
constexpr Nanoseconds say_again_after = milliseconds(20);

double seconds_of(Nanoseconds span) {
  return static_cast<double>(span) * 1e-9;
}
}  // namespace

Coordinator::Coordinator(const CoordinatorConfig& config, LocalRun& run, const StopRule& stop,
                         const std::atomic<bool>& interrupt,
                         std::function<void(const Progress&)> report, Scheduler& scheduler,
                         Network& network, Sender& sender)
    : NodeActor(scheduler, sender, {config.self, ActorName::coordinator}, "tally"),
      config_(config),
      run_(run),
      stop_(stop),
      interrupt_(interrupt),
      report_(std::move(report)),
      clock_(scheduler.clock()),
      network_(network),
      book_(run.batches(), run.missing(), config.first_lease,
            config.look_ahead * static_cast<int64_t>(config.workers.size())),
      shards_(config.shards, run.totals(), clock_, sender, address()),
      shows_(config.display, run, sender, address()),
      plan_(run.scene()),
      target_(stop.target_batches(run.scene().batch_particles)),
      batches_at_start_(run.traced()),
      began_(clock_.now()),
      error_(std::numeric_limits<double>::quiet_NaN()) {
  for (const NodeId worker : config_.workers) peers_[worker];
  untold_.reserve(config_.workers.size());
  uncounted_.reserve(2 * config_.workers.size());
}

void Coordinator::start() {
  NodeActor::start();
  began_ = clock_.now();
  next_word_ = began_ + waiting_word;
  set_timer();
  if (!nothing_left()) return;
  begun_ = done_before_ = true;
  note_book();
  end_run(book_.committed() >= target_ ? StopReason::particles : StopReason::error);
}

/// Whether what was counted by an earlier life is all that was asked for. Then nobody is waited
/// for: workers that have heard of the end are gone.
bool Coordinator::nothing_left() const {
  if (book_.committed() >= target_) return true;
  if (!stop_.relative_error || book_.committed() == 0 || !book_.missing().empty()) return false;
  if (run_.plan().round_end(book_.committed() - 1) != book_.committed()) return false;
  return stop_.error_is_reached(Readout(run_.scene(), run_.totals()).worst_relative_error());
}

// ---- workers that come and go ------------------------------------------------------------------

/// A message of a worker says that it is here, in this life. False: it is of a life that has ended.
bool Coordinator::meet(Address worker, Incarnation life) {
  const auto at = peers_.find(worker.node);
  if (at == peers_.end()) return false;
  Peer& peer = at->second;
  if (std::count(peer.former.begin(), peer.former.end(), life) > 0) return false;
  if (peer.life != life) {
    if (peer.life != Incarnation{}) {
      peer.former.push_back(peer.life);
      fence(book_.fence_node(worker.node), "its worker began anew");
      book_.forgive(worker.node);
      shards_.end_life(worker.node, peer.life);
      shows_.end_life(worker.node);
      lose_shard(worker.node, "began anew");
    }
    peer.life = life;
    peer.told.reset();
    peer.left = false;
  }
  peer.here = true;
  const auto here = [](const auto& entry) { return entry.second.here; };
  if (!begun_ && !over_ && std::all_of(peers_.begin(), peers_.end(), here)) begin();
  return true;
}

void Coordinator::begin() {
  begun_ = true;
  began_ = clock_.now();
  log_info("run=begun workers={}", peers_.size());
  note_book();
  open_round();
}

void Coordinator::await_workers(Nanoseconds now) {
  if (const auto taken = network_.taken_elsewhere()) {
    // Where its results go is in the words of the refusal, which the node adds to this.
    fault_ =
        problem(fmt::format("the run did not begin, since its workers are not free: let the "
                            "run that {} works for end first, or give this one other workers",
                            name_of(*taken)));
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
                               seconds_of(config_.start), missing_workers()));
  end_run(StopReason::workers_lost);
}

std::string Coordinator::name_of(NodeId node) const {
  return node.value < config_.names.size() ? config_.names[node.value]
                                           : fmt::format("node {}", node.value);
}

/// Who is not here, and why as far as this node can know: of its own links, that is.
std::string Coordinator::missing_workers() const {
  const std::vector<NodeId> own = network_.neighbours();
  std::string text;
  for (const auto& [worker, peer] : peers_) {
    if (peer.here) continue;
    const std::string refusal = network_.refusal_of(worker);
    const bool linked = std::count(own.begin(), own.end(), worker) > 0;
    text += fmt::format("{}{} has not come ({})", text.empty() ? "" : "; ", name_of(worker),
                        !refusal.empty() ? refusal
                        : linked         ? "there is no link to it: see its log"
                                         : "it has no link to this node: see its log");
  }
  return text;
}

void Coordinator::watch_workers(Nanoseconds now) {
  for (auto& [worker, peer] : peers_) {
    if (network_.reaches(worker)) {
      peer.unreachable_since.reset();
      continue;
    }
    if (!peer.unreachable_since) peer.unreachable_since = now;
    if (!begun_ || !peer.here || now - *peer.unreachable_since < config_.lost) continue;
    peer.here = false;
    ++counters_.workers_lost;
    log_error(
        "worker=lost node={} text=\"no way has led to {} for {:g} s: its batches are lent "
        "again\"",
        worker.value, name_of(worker), seconds_of(config_.lost));
    fence(book_.fence_node(worker), "its worker is lost");
    lose_shard(worker, "is lost");
  }
  // With shards, who is out of reach is waited for until it is lost: then the run has failed.
  if (!begun_ || over_ || adding_ || reading_ || !all_gone() || shards_.others() > 0) return;
  if (!closing_) return end_run(StopReason::workers_lost);
  end_run(interrupt_.load() ? StopReason::interrupted : StopReason::time);
}

/// Whether nobody is left to trace: all are lost, or out of reach when the run is ending anyway.
bool Coordinator::all_gone() const {
  return std::all_of(peers_.begin(), peers_.end(), [&](const auto& entry) {
    return !entry.second.here || (closing_ && entry.second.unreachable_since);
  });
}

/// What a worker held of the totals is nowhere else.
void Coordinator::lose_shard(NodeId worker, const char* how) {
  if (!begun_ || !shards_.owns(worker)) return;
  fail(
      fmt::format("{} {}, and with it a shard of the totals, so that this run has no result: "
                  "begin anew, with fewer shards or other nodes in [tally] shards",
                  name_of(worker), how));
}

void Coordinator::fail(const std::string& what) {
  if (over_) return;
  fault_ = problem(what);
  log_error("run=failed text=\"{}\"", what);
  end_run(StopReason::workers_lost);
}

/// Each node is told in as few messages as hold them: hundreds of leases may be fenced at once, and
/// a message for each would leave no room for an answer that somebody waits for.
void Coordinator::fence(const std::vector<Lease>& leases, const char* why) {
  std::map<NodeId, LeasesFenced> told;
  for (const Lease& lease : leases) {
    ++counters_.fenced;
    log_warning("lease=fenced lease={} node={} batch={} text=\"{}: lent again\"", lease.id,
                lease.node.value, lease.batch, why);
    LeasesFenced& of_node = told[lease.node];
    of_node.leases.push_back(lease.id);
    if (of_node.leases.size() < limits::leases) continue;
    send(lease.node, sender().next_id(), of_node);
    of_node.leases.clear();
  }
  for (const auto& [node, fenced] : told)
    if (!fenced.leases.empty()) send(node, sender().next_id(), fenced);
  if (!leases.empty()) offer_again();
}

/// Who was told that there is no more in this round would ask again when its patience is over. That
/// is too late for batches that have just come back.
void Coordinator::offer_again() {
  if (!begun_ || over_ || book_.waiting() == 0) return;
  const RoundOpened more{round(), static_cast<uint64_t>(book_.end())};
  for (const auto& [worker, last] : last_grant_)
    if (std::get<LeaseGranted>(last.answer).batches == 0) send(worker, sender().next_id(), more);
}

/// What nobody can trace is lost, and the run with it: what has been lent is brought to its end,
/// and no more is lent, since the next batches would need the same objects.
void Coordinator::lose_batches() {
  std::vector<NodeId> here;
  for (const auto& [worker, peer] : peers_)
    if (peer.here) here.push_back(worker);
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

void Coordinator::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"leases_lent", "", "Batches lent.", ""}, c.leases);
  metrics.add_counter({"leases_fenced", "", "Leases that were late, or whose node was gone.", ""},
                      c.fenced);
  metrics.add_counter({"batches_lost", "", "Batches that nobody who is left could trace.", ""},
                      c.batches_lost);
  metrics.add_counter({"flushes_taken", "", "Flushes counted.", ""}, c.flushes_taken);
  metrics.add_counter({"flushes_not_taken", "", "Flushes refused.", ""}, c.flushes_refused);
  metrics.add_counter({"flushes_not_kept", "", "Flushes that the journal could not take.", ""},
                      c.flushes_not_kept);
  metrics.add_counter({"flush_in", "bytes", "Bytes of flushes that came.", ""}, c.flush_bytes);
  metrics.add_counter({"batches_counted", "", "Batches counted.", ""}, c.batches);
  metrics.add_counter({"particles_counted", "", "Particles of batches counted.", ""}, c.particles);
  if (shards_.others() > 0) {
    const ShardControl::Counters& s = shards_.counters();
    metrics.add_counter({"shard_decisions", "", "Decisions to be told to shards.", ""},
                        s.decisions);
    metrics.add_counter({"gathers", "", "Times that shards' totals were brought here.", ""},
                        s.gathers);
    metrics.add_counter({"gathered", "bytes", "Bytes of totals that shards told.", ""},
                        s.gathered_bytes);
  }
  metrics.add_gauge({"round", "", "Rounds begun.", ""}, c.round);
  metrics.add_gauge({"leases_out", "", "Leases that stand.", ""}, c.leases_out);
}

void Coordinator::note_book() {
  counters_.batches = static_cast<uint64_t>(book_.committed());
  counters_.leases_out = book_.standing();
  counters_.particles = counters_.batches * static_cast<uint64_t>(run_.scene().batch_particles);
}

// ---- rounds ----------------------------------------------------------------------------------

void Coordinator::open_round() {
  const int64_t planned =
      stop_.next_wait(book_.committed(), run_.scene().batch_particles, run_.plan());
  const int64_t end = std::max(planned, book_.lent_end());  // of an earlier run, that lacks some
  book_.open_until(end);
  ++counters_.round;
  for (const NodeId worker : config_.workers)
    send(worker, sender().next_id(), RoundOpened{round(), static_cast<uint64_t>(end)});
}

/// Ends the round when everything of it is counted, and lets somebody look at the totals where that
/// is due. With shards the totals are first brought here, when every decision is answered.
/// Meanwhile no flush is counted, so that they fit together.
void Coordinator::look_at_totals() {
  if (!begun_ || over_) return;
  if (shards_.fault()) return fail(*shards_.fault());
  if (adding_ || reading_ || shards_.gathering()) return;
  const bool round_done = book_.round_done();
  if (!round_done && !run_.pause_is_due() && !shows_.wanted()) return go_on_counting();
  if (shards_.others() > 0 && !gathered_) {
    if (counting_ || !shards_.settled()) return;  // called again when they are
    return shards_.gather([this] {
      gathered_ = true;
      look_at_totals();
    });
  }
  read_totals(round_done);
}

/// Millions of bins, files and pictures take longer than a turn may.
void Coordinator::read_totals(bool round_done) {
  reading_ = true;
  packing_ = shows_.begin_pack();
  if (run_.pause_is_due() || packing_) run_.resume(book_.lent_end(), book_.missing());
  const auto read = [this, round_done, packs = packing_, seconds = shown_seconds()] {
    try {
      run_.pause_if_due();
      if (packs) shows_.pack(run_, seconds);
      if (round_done) read_error_ = Readout(run_.scene(), run_.totals()).worst_relative_error();
    } catch (...) {
      reading_failed_ = std::current_exception();
    }
  };
  config_.calls->begin(read, own_task([this, round_done] { totals_read(round_done); }));
}

void Coordinator::totals_read(bool round_done) {
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

void Coordinator::end_round() {
  if (book_.lost() > 0) return end_run(StopReason::objects_lost);
  const bool interrupted = closing_ && interrupt_.load();
  const RunProgress here{book_.committed(), error_, interrupted, closing_ && !interrupted};
  const auto reason = stop_.reason_to_stop(here, run_.scene().batch_particles);
  reason ? end_run(*reason) : open_round();
}

void Coordinator::end_run(StopReason reason) {
  reason_ = reason;
  over_ = true;
  over_since_ = clock_.now();
  config_.calls->finish();
  if (config_.journal != nullptr) config_.journal->finish();
  go_on_counting();  // what is left is refused
  next_word_ = over_since_ + waiting_word;
  run_.resume(book_.lent_end(), book_.missing());
  tell_end();
}

// The end. Were this node to leave before a worker has heard of it, that worker would wait for
// `lost` and take a run that ended well for one that failed; and were workers to leave as soon as
// they have heard, those behind them would be cut off. So all stay until each has answered, or is
// lost: a worker that no way leads to gives the run up by itself after the same time. What a worker
// has heard it forgets when it crashes, so all are asked again and again until all have answered
// lately.
// Then all are let go, and tell their neighbours as they leave. Who interrupts the run waits for
// nobody who is out of reach.

RunEnded Coordinator::end_word() const {
  return {round(), fault_ ? fault_->what.substr(0, limits::text_bytes) : ""};
}

/// Were this node to crash while its journal lacks work, that work would be traced again: by
/// workers that have not heard of an end. After `lost` the disk is given up.
bool Coordinator::awaits_journal() const {
  return config_.journal != nullptr && !config_.journal->is_whole() && !fault_ &&
         !interrupt_.load() && over_for() < config_.lost;
}

/// Whom there was no room for the last time comes first, or a full outbox would hide the end from
/// the same workers each time.
void Coordinator::tell_end() {
  if (awaits_journal()) return;
  shows_.tell_end(end_word());  // first: without room it would be told at the next look
  for (const auto& [worker, peer] : peers_)
    if ((peer.here || done_before_) && std::count(untold_.begin(), untold_.end(), worker) == 0)
      untold_.push_back(worker);
  tell_untold();
  let_go_when_told();
}

/// Until the network has taken the word for each.
void Coordinator::tell_untold() {
  std::erase_if(untold_, [&](NodeId worker) {
    return send(worker, sender().next_id(), end_word()) != SendOutcome::full;
  });
  if (untold_.empty() || telling_) return;
  telling_ = true;
  scheduler().timers().set(clock_.now() + say_again_after, own_task([this] {
                             telling_ = false;
                             tell_untold();
                           }));
}

/// Who asks for work then has begun anew since it was told. An answer without batches would have it
/// wait for the next round, of a controller that may leave before it can say more.
void Coordinator::answer_with_end(const Letter<RequestLease>& request) {
  if (awaits_journal()) {
    answer(request, grant_of({}));
    return;
  }
  answer(request, end_word());
  if (letting_go_) tell(request.from, EnterPhase{EndPhase::leave, 0});
}

bool Coordinator::knows_end(NodeId worker, const Peer& peer) const {
  if (peer.left) return true;
  // Who has not been heard of may wait for a word of the end, when an earlier life counted it.
  if (!peer.here) return !done_before_;
  if (!network_.reaches(worker)) return interrupt_.load();
  return peer.told && clock_.now() - *peer.told <= heard_lately * config_.look_every;
}

void Coordinator::let_go_when_told() {
  if (letting_go_) return;
  const auto knows = [&](const auto& entry) { return knows_end(entry.first, entry.second); };
  const bool all_know = std::all_of(peers_.begin(), peers_.end(), knows);
  if (awaits_journal() || !show_is_settled() || (!all_know && over_for() < config_.lost)) return;
  if (letting_go_) return;
  letting_go_ = true;
  let_go();
}

/// Until the network has taken the word for each that it can reach.
void Coordinator::let_go() {
  const EnterPhase leave{EndPhase::leave, 0};
  for (auto& [worker, peer] : peers_)
    if (!peer.gone) peer.gone = send(worker, sender().next_id(), leave) != SendOutcome::full;
  if (ended()) return;
  scheduler().timers().set(clock_.now() + say_again_after, own_task([this] { let_go(); }));
}

bool Coordinator::ended() const {
  return letting_go_ &&
         std::all_of(peers_.begin(), peers_.end(), [](const auto& at) { return at.second.gone; });
}

std::string Coordinator::who_lacks_end() const {
  std::string text;
  for (const auto& [worker, peer] : peers_)
    if (!knows_end(worker, peer)) text += (text.empty() ? "" : ", ") + name_of(worker);
  return text;
}

// ---- what passes with time -------------------------------------------------------------------

/// After `look_every`, or as soon as a lease is late.
void Coordinator::set_timer() {
  const Nanoseconds now = clock_.now();
  Nanoseconds next = now + config_.look_every;
  if (const auto late = book_.next_deadline(); late && !over_)
    next = std::min(next, std::max(*late, now + least_between_looks));
  scheduler().timers().set(next, own_task([this] {
                             look();
                             set_timer();
                           }));
}

void Coordinator::look() {
  const Nanoseconds now = clock_.now();
  watch_workers(now);
  if (over_) return wait_for_farewells(now);
  if (!begun_) return await_workers(now);
  report_(progress());
  shards_.look();
  fence(book_.fence_late(now), "late");
  lose_batches();
  note_book();
  tidy_journal();
  const double passed = static_cast<double>(now - began_) * 1e-9;
  if (!closing_ && (interrupt_.load() || stop_.time_is_up(passed))) {
    closing_ = true;
    book_.close();
  }
  look_at_totals();
}

void Coordinator::wait_for_farewells(Nanoseconds now) {
  tidy_journal();
  tell_end();
  if (letting_go_ || now < next_word_) return;
  next_word_ = now + waiting_word;
  if (awaits_journal()) {
    log_info(
        "run=over text=\"its workers stay until the journal has what it lacks: that takes {:g} s "
        "(lost_s) at most\"",
        seconds_of(config_.lost));
    return;
  }
  log_info("run=over text=\"{} must hear of it, or be lost: that takes {:g} s (lost_s) at most\"",
           who_lacks_end(), seconds_of(config_.lost));
}

Progress Coordinator::progress() const {
  const double passed = static_cast<double>(clock_.now() - began_) * 1e-9;
  return progress_of(stop_, run_.scene().batch_particles, batches_at_start_, book_.committed(),
                     passed, error_);
}

// ---- messages --------------------------------------------------------------------------------

/// What finds no room or no way is asked for again by the worker, or said again by look().
SendOutcome Coordinator::send(NodeId worker, const MessageId& id, const Message& message) {
  return sender().send(address(), {worker, ActorName::tracer}, id, message);
}

void Coordinator::on(const Letter<FlushSettled>& settled) {
  shards_.on(settled);
  look_at_totals();
}

void Coordinator::on(const Letter<TotalsTold>& told) {
  shards_.on(told);
  look_at_totals();
}

/// A worker has tried these for as long as one waits for a lost node: it cannot have an object.
void Coordinator::on(const Letter<LeasesFenced>& given_back) {
  const NodeId worker = given_back.from.node;
  if (!meet(given_back.from, given_back.id.incarnation)) return;
  for (const Lease& lease : book_.give_back(worker, given_back.body.leases))
    log_warning(
        "lease=given_back lease={} node={} batch={} text=\"{} cannot have an object that it needs: "
        "lent to others\"",
        lease.id, worker.value, lease.batch, name_of(worker));
  offer_again();
}

/// Nobody takes more than its share of what is left, so that all end together.
uint32_t Coordinator::max_to_lend() const {
  if (scheduler().rarely(Buggify::Site::small_grant)) return 1;
  const auto workers = static_cast<int64_t>(peers_.size());
  const int64_t share = (book_.waiting() + workers - 1) / workers;
  return static_cast<uint32_t>(std::clamp<int64_t>(share, 1, config_.max_leases));
}

LeaseGranted Coordinator::grant_of(const LentBatches& lent) const {
  return {lent.first_lease, round(), static_cast<uint64_t>(lent.first_batch),
          static_cast<uint32_t>(lent.count),
          static_cast<uint32_t>(config_.lease_time / milliseconds(1))};
}

void Coordinator::on(const Letter<RequestLease>& request) {
  const NodeId worker = request.from.node;
  if (!meet(request.from, request.id.incarnation)) return;
  Peer& peer = peers_[worker];
  const uint32_t batches = request.body.batches;
  peer.left = batches == 0 && !over_;
  if (batches == 0) {
    if (!over_) return;
    peer.told = clock_.now();
    return let_go_when_told();
  }
  if (over_) return answer_with_end(request);
  Answered& last = last_grant_[worker];
  if (last.question != request.id) {
    const LentBatches lent = book_.lend(worker, std::min(batches, max_to_lend()), clock_.now(),
                                        config_.lease_time, rank_of(worker));
    counters_.leases += static_cast<uint64_t>(lent.count);
    note_book();
    last = {request.id, grant_of(lent)};
  }
  answer(request, last.answer);
}

LeaseBook::Rank Coordinator::rank_of(NodeId worker) {
  if (worker.value >= config_.group_ranks.size()) return {};
  return [this, &ranks = config_.group_ranks[worker.value]](int64_t batch) {
    return ranks[group_of(batch)];
  };
}

size_t Coordinator::group_of(int64_t batch) {
  while (static_cast<int64_t>(groups_.size()) <= batch)
    groups_.push_back(static_cast<uint32_t>(plan_.next().group));
  return groups_[static_cast<size_t>(batch)];
}

}  // namespace luxodus
