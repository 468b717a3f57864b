#include "actors/cast/tracing/tracing_worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "actors/cast/names/role.hpp"
#include "runtime/core/check.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Bins per step: at about 20 ns a bin this is a third of a millisecond.
constexpr int64_t bins_of_a_step = 16384;

/// A question is retried at the latest after the time in which a coordinator is given up.
RetryTimer retry_timer(const TracingWorkerConfig& config) {
  return {config.answer_patience, config.lost};
}

size_t batches_of(const Totals& totals) {
  int64_t batches = 0;
  for (int group = 0; group < totals.groups(); ++group) batches += totals.batches(group);
  return static_cast<size_t>(batches);
}
}  // namespace

TracingWorker::TracingWorker(const TracingWorkerConfig& config, const ShardPlan& shards,
                             Scheduler& scheduler, Network& network, Sender& sender)
    : NodeActor(scheduler, sender, {config.self, role::tracer}, "flush"),
      config_(config),
      clock_(scheduler.clock()),
      network_(network),
      slices_(shards, sender, address(), retry_timer(config)),
      lease_timer_(retry_timer(config)),
      flush_timer_(lease_timer_),
      state_timer_(lease_timer_),
      began_(clock_.now()) {
  counters_.led_by = coordinator().node.value;
}

void TracingWorker::start(LeasedWork& work) {
  NodeActor::start();
  work_ = &work;
  began_ = clock_.now();
  make_encoders();
  done_.reserve(limits::leases);
  packed_leases_.reserve(limits::leases);
  set_timer();
}

/// Makes encoders for the present totals: another state of the scene may have other bins.
void TracingWorker::make_encoders() {
  const Totals& totals = work_->totals();
  slices_.make_room(totals.groups(), totals.layout().totals());
  const BinRange own = slices_.own_bins();
  encoder_ = std::make_shared<FlushEncoder>(totals.groups(), own.end - own.first);
}

void TracingWorker::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"leases", "", "Batches lent to this node.", ""}, c.leases);
  metrics.add_counter({"leases_failed", "", "Leases whose batch is traced anew.", ""},
                      c.leases_failed);
  metrics.add_counter({"leases_given_back", "", "Leases whose batch cannot be traced here.", ""},
                      c.leases_given_back);
  metrics.add_gauge({"led_by", "", "Number of the node whose coordinator leads this one.", ""},
                    c.led_by);
  metrics.add_counter({"coordinators_left", "", "Coordinators that were lost and left.", ""},
                      c.coordinators_left);
  metrics.add_counter({"flushes", "", "Flushes made.", ""}, c.flushes);
  metrics.add_counter({"flushes_refused", "", "Flushes that the controller refused.", ""},
                      c.flushes_refused);
  metrics.add_counter({"flush", "bytes", "Bytes of flushes made.", ""}, c.flush_bytes);
  metrics.add_counter({"asked_again", "", "Questions to the controller asked again.", ""},
                      c.asked_again);
}

// ---- asking for work -------------------------------------------------------------------------

void TracingWorker::want_leases(size_t count) {
  wanted_ = count;
  ask();
}

void TracingWorker::ask() {
  if (asking_ || over_ || draining_ || round_empty_ || wanted_ == 0) return;
  if (scheduler().rarely(Buggify::Site::small_wish)) wanted_ = 1;
  asking_ = question(lease_timer_, RequestLease{static_cast<uint32_t>(wanted_)});
  wanted_ = 0;
  put(*asking_);
}

void TracingWorker::on(const Letter<LeaseGranted>& granted) {
  if (!hears(granted.from)) {
    std::erase_if(left_, [&](const Left& left) {
      return left.whom == granted.from && left.word == granted.id;
    });
    return;
  }
  if (!asking_ || asking_->id != granted.id) return;  // a duplicate answer
  const LeaseGranted& grant = granted.body;
  const uint32_t asked_for = std::get<RequestLease>(asking_->message).batches;
  asking_.reset();
  lease_timer_.answered(clock_.now());
  if (asked_for == 0) {
    returned_ = true;
    return work_->drop_all();
  }
  returned_ = false;
  const uint32_t last_round = std::exchange(round_, grant.round);
  lease_time_ = milliseconds(grant.duration_ms);
  counters_.leases += grant.batches;
  rumour_ = rumour_ && grant.batches == 0;
  if (grant.batches > 0 && !work_->is_in(grant.state)) begin_state(grant.state);
  // Batches merged but not flushed when another round begins have fenced leases.
  if (grant.round != last_round && !done_.empty()) flush();
  work_->enter_round(grant.round);
  for (uint32_t i = 0; i < grant.batches; ++i) {
    work_->add(grant.first_lease + i, static_cast<int64_t>(grant.first_batch + i));
  }
  wanted_ = 0;  // wanted before this answer
  if (grant.batches > 0) {
    work_->look_again();
    // Preferred batches are seldom adjacent, and come in several answers.
    if (grant.batches < asked_for) want_leases(asked_for - grant.batches);
    return;
  }
  round_empty_ = true;
  flush_when_idle();
}

/// The next round is open, or may be: the message may be lost.
void TracingWorker::begin_round() {
  round_empty_ = false;
  work_->look_again();
}

// ---- states of the scene -----------------------------------------------------------------------

/// The work at hand is of another state, whose leases are fenced.
void TracingWorker::begin_state(ObjectId state) {
  if (entering_ == state) return;
  entering_ = state;
  work_->leave_state();
  done_.clear();
  if (flushing_) forget_flush();
  work_->knows(state) ? enter_state() : ask_state(state);
}

void TracingWorker::ask_state(ObjectId state) {
  learning_ = question(state_timer_, AskState{state});
  put(*learning_);
}

/// Builds the state here and now: this node has nothing else to do until then.
void TracingWorker::on(const Letter<StateTold>& told) {
  if (!hears(told.from) || !learning_ || learning_->id != told.id) return;
  learning_.reset();
  state_timer_.answered(clock_.now());
  const std::span<const std::byte> bytes = told.payload.bytes();
  if (bytes.empty()) return cannot_enter(problem("nobody knows it any more"));
  if (const auto learnt = work_->learn(told.body.state, bytes); !learnt)
    return cannot_enter(learnt.problem());
  enter_state();
}

/// Enters the state once it is known, and the previous one's flush is packed.
void TracingWorker::enter_state() {
  if (!entering_ || packing_) return;
  if (!work_->knows(*entering_)) {  // another one was received meanwhile
    if (!learning_) ask_state(*entering_);
    return;
  }
  work_->enter(*std::exchange(entering_, std::nullopt));
  make_encoders();
  work_->look_again();
}

/// Other nodes may. A state that was only announced is requested again when it is entered.
void TracingWorker::cannot_enter(const Problem& why) {
  if (!entering_) return;
  log_error("state=unknown text=\"this node cannot enter a state of the scene: {}\"", why.what);
  entering_.reset();
  work_->give_back_all();
  work_->look_again();
}

// ---- flushes ---------------------------------------------------------------------------------

void TracingWorker::leases_done(std::span<const uint64_t> leases) {
  for (const uint64_t lease : leases)
    std::erase_if(in_vain_, [&](const InVain& vain) { return vain.lease == lease; });
  if (done_.empty()) first_done_ = clock_.now();
  done_.insert(done_.end(), leases.begin(), leases.end());
  if (rested(clock_.now()) || flush_due_ || done_.size() == limits::leases ||
      scheduler().rarely(Buggify::Site::early_flush))
    flush();
  flush_when_idle();
}

/// Whether the oldest merged batch has waited for the flush interval.
bool TracingWorker::rested(Nanoseconds now) const {
  const Nanoseconds most = flush_interval(config_.flush_every, flush_cost_, lease_time_);
  return !done_.empty() && now - first_done_ >= most;
}

/// A momentary loss: the batch is traced again, and the lease is valid until its deadline. After
/// the lost-node timeout the loss is permanent: the batch is given back, since others may have the
/// object.
void TracingWorker::lease_failed(uint64_t lease, int64_t batch) {
  ++counters_.leases_failed;
  if (over_) return;
  if (clock_.now() - vain_since(lease, batch) < config_.lost) return work_->add(lease, batch);
  give_back({&lease, 1});
  work_->look_again();
  flush_when_idle();
}

bool TracingWorker::give_back(std::span<const uint64_t> leases) {
  counters_.leases_given_back += leases.size();
  const LeasesFenced given_back{{leases.begin(), leases.end()}};
  return tell(coordinator(), given_back) != SendOutcome::full;
}

void TracingWorker::return_leases() {
  if (over_) return;
  if (packing_ || flushing_ || !done_.empty()) return flush();
  if (asking_) return;
  // Repeated now and then, even with nothing to return: a restarted coordinator does not know it.
  if (work_->at_hand() == 0 && returned_ && !lease_timer_.has_rested(clock_.now())) return;
  asking_ = question(lease_timer_, RequestLease{0});
  put(*asking_);
}

/// Since when tries of a batch have failed here, under any lease.
Nanoseconds TracingWorker::vain_since(uint64_t lease, int64_t batch) {
  const auto known = std::find_if(in_vain_.begin(), in_vain_.end(),
                                  [&](const InVain& vain) { return vain.batch == batch; });
  if (known != in_vain_.end()) {
    known->lease = lease;
    return known->since;
  }
  if (in_vain_.size() == limits::leases) in_vain_.erase(in_vain_.begin());
  return in_vain_.emplace_back(InVain{lease, batch, clock_.now()}).since;
}

void TracingWorker::want_room() {
  room_wanted_ = true;
  flush();
}

/// The round has no more batches: the controller waits for those at hand.
void TracingWorker::flush_when_idle() {
  if ((round_empty_ || draining_) && work_->at_hand() == 0) flush();
}

void TracingWorker::flush() {
  if (packing_ || flushing_ || over_ || done_.empty())
    return;  // the answer to the current one sends the next
  flush_due_ = !encoder_is_free() || !work_->may_give();
  if (flush_due_) return;
  room_wanted_ = false;
  packing_ = true;
  packed_leases_.swap(done_);
  Totals& totals = work_->give_totals();
  // The coordinator cannot tell a batch from another: it would count one twice and another never.
  LUX_CHECK(batches_of(totals) == packed_leases_.size(), "totals of other batches than were done");
  LUX_CHECK(offer(PackFlush{&totals}) == Offered::taken, "it packs one at a time");
}

bool TracingWorker::encoder_is_free() const {
  return encoder_.use_count() == 1 && slices_.free();
}

/// Runs on the actor's fiber, between the turns of the photon-threads.
void TracingWorker::on(const PackFlush& pack) {
  packing_took_ = 0;
  if (!pack_all(*pack.totals)) {
    packing_ = false;
    packed_leases_.clear();
    return enter_state();
  }
  const std::span<const std::byte> payload = encoder_->bytes();
  // as Hasher, but without allocating
  const uint64_t hash = hash_of(payload);
  packing_ = false;
  if (over_) return;
  flushing_ = question(flush_timer_, Flush{round_, hash, std::move(packed_leases_), {}},
                       {payload, encoder_});
  if (config_.trace != nullptr)
    config_.trace->begin(TraceKind::flush, trace_id(flushing_->id), payload.size());
  ++counters_.flushes;
  counters_.flush_bytes += payload.size();
  slices_.send(flushing_->id, clock_.now());
  put_flush();
  work_->look_again();  // the packed totals are free
}

/// False: the node is ending, or another state is to be entered.
bool TracingWorker::pack_all(Totals& totals) {
  for (size_t slice = 0; slice < slices_.slices(); ++slice)
    if (!pack_bins(slices_.encoder(slice), totals, slices_.bins_of(slice), FlushCounts::without))
      return false;
  return pack_bins(*encoder_, totals, slices_.own_bins(), FlushCounts::with);
}

bool TracingWorker::pack_bins(FlushEncoder& encoder, Totals& totals, const BinRange& bins,
                              FlushCounts counts) {
  encoder.begin(totals, bins, counts);
  for (bool done = false; !done;) {
    if (entering_) return false;
    const Nanoseconds begun = clock_.now();
    done = encoder.step(bins_of_a_step);
    packing_took_ += clock_.now() - begun;
    if (!done && scheduler().fibers().yield() == Wake::cancelled) return false;
  }
  return true;
}

/// Sends it when all slices are placed, and again whenever the answer is late.
void TracingWorker::put_flush() {
  flushing_->asked = clock_.now();
  if (!slices_.placed()) return;
  std::get<Flush>(flushing_->message).slice_hashes = slices_.hashes();
  put(*flushing_);
}

void TracingWorker::put_when_placed(const MessageId& flush) {
  if (flushing_ && flushing_->id == flush && slices_.placed()) put_flush();
}

void TracingWorker::on(const Letter<SliceHeld>& held) {
  slices_.on(held, clock_.now());
  put_when_placed(held.id);
}

void TracingWorker::on(const Letter<FlushTaken>& taken) {
  if (hears(taken.from)) flush_answered(taken.id, true);
}

/// A shard refuses a slice; the coordinator is then told so.
void TracingWorker::on(const Letter<FlushRefused>& refused) {
  if (refused.from.actor == role::tally_shard) {
    slices_.on(refused);
    put_when_placed(refused.id);
  } else if (hears(refused.from)) {
    flush_answered(refused.id, false);
  }
}

void TracingWorker::on(const Letter<LeasesFenced>& fenced) {
  if (!hears(fenced.from)) return;
  const std::vector<uint64_t>& leases = fenced.body.leases;
  work_->drop(leases);
  const auto is_fenced = [&](uint64_t lease) {
    return std::find(leases.begin(), leases.end(), lease) != leases.end();
  };
  if (!done_.empty() && std::all_of(done_.begin(), done_.end(), is_fenced) &&
      work_->forget_merged())
    done_.clear();
}

void TracingWorker::on(const Letter<RoundOpened>& opened) {
  if (!hears(opened.from)) return;
  if (!learning_ && !work_->knows(opened.body.state)) ask_state(opened.body.state);
  begin_round();
}

void TracingWorker::forget_flush() {
  packed_leases_ = std::move(std::get<Flush>(flushing_->message).leases);  // reuses its memory
  packed_leases_.clear();
  flushing_.reset();
}

void TracingWorker::flush_answered(const MessageId& answered, bool taken) {
  if (!flushing_ || flushing_->id != answered) return;
  flush_timer_.answered(clock_.now());
  const Nanoseconds answer_took = clock_.now() - flushing_->asked;
  flush_cost_ = packing_took_ + answer_took;
  if (config_.trace != nullptr) config_.trace->end(TraceKind::flush, trace_id(answered), taken);
  forget_flush();
  if (!taken) ++counters_.flushes_refused;  // its leases are leased again: nothing to do here
  flush_when_idle();
  if (room_wanted_) flush();
  work_->look_again();
}

// ---- the end ---------------------------------------------------------------------------------

void TracingWorker::drain() {
  draining_ = true;
  flush_when_idle();
}

bool TracingWorker::drained() const {
  return !asking_ && !packing_ && !flushing_ && done_.empty() && work_->at_hand() == 0;
}

void TracingWorker::say_goodbye() {
  tell(coordinator(), EnterPhase{EndPhase::leave, 0});
}

/// `abandoned`: this node gives the run up; otherwise it has heard of the end.
void TracingWorker::stop_work(std::optional<Problem> fault, bool abandoned) {
  if (std::exchange(over_, true)) return;
  fault_ = std::move(fault);
  asking_.reset();
  learning_.reset();
  flushing_.reset();  // everything is counted, or nothing more will be
  abandoned ? work_->abandon() : work_->end(end_word_.text);
}

void TracingWorker::end(std::optional<Problem> fault) {
  stop_work(std::move(fault), true);
  work_->let_go();
  ended_ = true;
}

/// Sent by the controller, which waits for all answers before it releases the workers; or by a
/// neighbour that was released. A neighbour's message could be of an earlier run. Until the
/// controller has leased something to this node, or has told it of the end itself, the message is
/// only a rumour, which is believed if the controller never appears.
void TracingWorker::on(const Letter<RunEnded>& ended) {
  const bool first_hand = hears(ended.from) || leads_still(ended.from);
  // From a coordinator that was left for another: tells it not to wait for this node.
  if (!first_hand && ended.from.actor == role::coordinator) {
    tell(ended.from, RequestLease{0});
    return;
  }
  end_word_ = ended.body;
  rumour_ = !first_hand && !over_ && counters_.leases == 0;
  if (rumour_) return;
  const auto says = [&] {
    return problem("the controller says: " + end_word_.text, ProblemKind::lost_peer);
  };
  stop_work(end_word_.text.empty() ? std::nullopt : std::optional(says()), false);
  // The coordinator repeats this message: no answer until the workers below know.
  if (work_->end_is_known()) tell(first_hand ? ended.from : coordinator(), RequestLease{0});
  if (!first_hand) let_go();
}

void TracingWorker::on(const Letter<EnterPhase>& phase) {
  const bool first_hand = hears(phase.from) || (over_ && leads_still(phase.from));
  if (first_hand && phase.body.phase == EndPhase::leave) let_go();
}

/// Tells neighbours first: without this node they may have no route to the controller.
void TracingWorker::let_go() {
  stop_work(std::nullopt, false);
  if (tell_) return;
  tell_ = network_.neighbours();
  std::erase(*tell_, config_.coordinators.back().node);  // which sent this message
  pass_on();
}

void TracingWorker::pass_on() {
  std::erase_if(*tell_,
                [&](NodeId neighbour) { return tell_neighbour(neighbour) != SendOutcome::full; });
  if (tell_->empty()) return end(std::nullopt);
  scheduler().timers().set(clock_.now() + retry_after, own_task([this] { pass_on(); }));
}

SendOutcome TracingWorker::tell_neighbour(NodeId neighbour) {
  return tell({neighbour, role::tracer}, end_word_);
}

void TracingWorker::tell_end(NodeId neighbour) {
  if (tell_ && neighbour != config_.coordinators.back().node) (void)tell_neighbour(neighbour);
}

void TracingWorker::watch_coordinator(Nanoseconds now) {
  if (ended_ || tell_) return;
  if (!network_.reaches(coordinator().node)) {
    if (!unreachable_since_) unreachable_since_ = now;
  } else if (unreachable_since_) {
    unreachable_since_.reset();
    ask_now();
  }
  const auto give_up = [&](const char* what, Nanoseconds after, const char* key) {
    if (rumour_) return end(std::nullopt);
    end(problem(fmt::format("{} for {:g} s ({})", what, seconds_in(after), key),
                ProblemKind::lost_peer));
  };
  const Nanoseconds unreachable = unreachable_since_ ? now - *unreachable_since_ : 0;
  const bool lost = unreachable >= config_.lost;
  // A controller restarted after a crash would ask again which workers know of the end.
  if (over_) return lost ? end(std::nullopt) : void();
  const Nanoseconds patience = heard_ ? std::min(config_.rejoin, config_.lost) : config_.start / 2;
  if (unreachable >= patience && join_another()) return;
  if (!heard_ && now - began_ >= config_.start)
    give_up("the controller has not been heard of", config_.start, "start_s");
  else if (heard_ && lost)
    give_up("no way has led to the controller", config_.lost, "lost_s");
}

/// Joins the first reachable coordinator; returns false if there is none. The lost coordinator's
/// leases are gone, and so is what it was told. An unanswered flush is sent to the next one, which
/// knows none of its leases, and refuses it.
bool TracingWorker::join_another() {
  size_t next = 0;
  const auto& all = config_.coordinators;
  while (next < all.size() && (next == led_by_ || !network_.reaches(all[next].node))) ++next;
  if (next == all.size()) return false;
  ++counters_.coordinators_left;
  log_warning("coordinator=lost node={} next={}", coordinator().node.value, all[next].node.value);
  left_.push_back({coordinator(), sender().next_id()});
  std::erase_if(left_, [&](const Left& left) { return left.whom == all[next]; });
  led_by_ = next;
  counters_.led_by = coordinator().node.value;
  unreachable_since_.reset();
  asking_.reset();
  returned_ = false;
  known_here_ = false;
  round_empty_ = false;
  work_->drop_all();
  work_->look_again();
  return true;
}

/// Repeated, once the coordinator that was left is reachable; but not before another coordinator
/// knows of this node, since one must wait for it at the end.
void TracingWorker::take_leave() {
  if (!known_here_) return;
  for (const Left& left : left_)
    if (network_.reaches(left.whom.node))
      sender().send(address(), left.whom, left.word, EnterPhase{EndPhase::leave, 0});
}

// ---- questions and answers -------------------------------------------------------------------

TracingWorker::Question TracingWorker::question(RetryTimer& timer, Message message,
                                                SharedBytes payload) {
  timer.forget();  // the previous one of its kind may have been given up
  return {sender().next_id(), &timer, std::move(message), std::move(payload)};
}

void TracingWorker::put(Question& question) {
  const SendOutcome outcome =
      sender().send(address(), coordinator(), question.id, question.message, question.payload);
  question.asked = clock_.now();
  question.left = outcome == SendOutcome::taken;
  if (question.left) question.timer->asked(question.asked);
  if (question.left || retries_soon_) return;
  retries_soon_ = true;
  scheduler().timers().set(question.asked + retry_after, own_task([this] { retry(); }));
}

/// Sends again what found no room or no route.
void TracingWorker::retry() {
  retries_soon_ = false;
  if (asking_ && !asking_->left) put(*asking_);
  if (learning_ && !learning_->left) put(*learning_);
  if (flushing_ && !flushing_->left && slices_.placed()) put(*flushing_);
}

/// The coordinator is reachable again. Messages in flight may be lost with the old route; or the
/// coordinator has restarted, and knows of no worker.
void TracingWorker::ask_now() {
  if (over_) return;
  if (asking_) put(*asking_);
  if (learning_) put(*learning_);
  if (flushing_) {
    slices_.ask_now(clock_.now());
    put_flush();
  }
  if (round_empty_) begin_round();
}

void TracingWorker::set_timer() {
  scheduler().timers().set(clock_.now() + config_.answer_patience / 4,
                           own_task([this] { on_timer(); }));
}

void TracingWorker::on_timer() {
  const Nanoseconds now = clock_.now();
  for (std::optional<Question>* question : {&asking_, &flushing_, &learning_}) {
    if (!*question || !(*question)->timer->is_due(now)) continue;
    ++counters_.asked_again;
    question == &flushing_ ? put_flush() : put(**question);
  }
  if (flushing_) slices_.ask_again(now);
  if (rested(now) || flush_due_) flush();
  if (round_empty_ && !over_ && lease_timer_.has_rested(now)) begin_round();
  watch_coordinator(now);
  take_leave();
  set_timer();
}

/// Whether a letter is from the coordinator; if so, it counts as heard.
bool TracingWorker::hears(Address from) {
  if (from != coordinator()) return false;
  heard_ = known_here_ = true;
  return true;
}

/// Whether this coordinator was left, and no other knows of this node yet.
bool TracingWorker::leads_still(Address from) const {
  return !known_here_ && std::any_of(left_.begin(), left_.end(),
                                     [&](const Left& left) { return left.whom == from; });
}

}  // namespace luxodus
