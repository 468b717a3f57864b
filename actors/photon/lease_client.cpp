#include "actors/photon/lease_client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "runtime/core/check.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {
/// At some 20 ns a bin this is half a turn of fibers.
constexpr int64_t bins_of_a_step = 16384;
/// Until a question is put again that did not leave this node: about as soon as links stand.
constexpr Nanoseconds retry_after = milliseconds(20);
}  // namespace

LeaseClient::LeaseClient(const LeaseClientConfig& config, Scheduler& scheduler, Network& network,
                         SliceSender& slices)
    : config_(config),
      scheduler_(scheduler),
      network_(network),
      slices_(slices),
      began_(scheduler.clock().now()) {}

void LeaseClient::start(PhotonThreads& photons) {
  photons_ = &photons;
  began_ = scheduler_.clock().now();
  const Totals& totals = photons.totals();
  slices_.make_room(totals.groups(), totals.layout().totals());
  const BinRange own = slices_.own_bins();
  encoder_ = std::make_shared<FlushEncoder>(totals.groups(), own.end - own.first);
  done_.reserve(limits::leases);
  packed_leases_.reserve(limits::leases);
  set_timer();
}

void LeaseClient::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"leases", "", "Batches lent to this node.", ""}, c.leases);
  metrics.add_counter({"leases_failed", "", "Leases whose batch is traced anew.", ""},
                      c.leases_failed);
  metrics.add_counter({"leases_given_back", "", "Leases whose batch cannot be traced here.", ""},
                      c.leases_given_back);
  metrics.add_counter({"flushes", "", "Flushes made.", ""}, c.flushes);
  metrics.add_counter({"flushes_refused", "", "Flushes that the controller refused.", ""},
                      c.flushes_refused);
  metrics.add_counter({"flush", "bytes", "Bytes of flushes made.", ""}, c.flush_bytes);
  metrics.add_counter({"asked_again", "", "Questions to the controller asked again.", ""},
                      c.asked_again);
}

// ---- asking for work -------------------------------------------------------------------------

void LeaseClient::want_leases(size_t count) {
  wanted_ = count;
  ask();
}

void LeaseClient::ask() {
  if (asking_ || over_ || draining_ || round_empty_ || wanted_ == 0) return;
  if (scheduler_.rarely(Buggify::Site::small_wish)) wanted_ = 1;
  asking_ = Question{network_.next_id(), RequestLease{static_cast<uint32_t>(wanted_)}, {}};
  wanted_ = 0;
  put(*asking_);
}

void LeaseClient::granted(const MessageId& answered, const LeaseGranted& grant) {
  if (!asking_ || asking_->id != answered) return;  // an answer that came twice
  const uint32_t asked_for = std::get<RequestLease>(asking_->message).batches;
  asking_.reset();
  round_ = grant.round;
  lease_time_ = milliseconds(grant.duration_ms);
  counters_.leases += grant.batches;
  rumour_ = rumour_ && grant.batches == 0;
  for (uint32_t i = 0; i < grant.batches; ++i) {
    photons_->add(grant.first_lease + i, static_cast<int64_t>(grant.first_batch + i));
  }
  wanted_ = 0;  // said before this answer
  if (grant.batches > 0) {
    // Batches that this node prefers are seldom neighbours, and come in several answers.
    if (grant.batches < asked_for) want_leases(asked_for - grant.batches);
    return;
  }
  round_empty_ = true;
  emptied_ = scheduler_.clock().now();
  flush_when_idle();
}

/// The next round is open, or may be: the word of it can be lost.
void LeaseClient::begin_round() {
  round_empty_ = false;
  photons_->look_again();
}

// ---- giving results --------------------------------------------------------------------------

void LeaseClient::lease_done(uint64_t lease) {
  std::erase_if(in_vain_, [&](const InVain& vain) { return vain.lease == lease; });
  if (done_.empty()) first_done_ = scheduler_.clock().now();
  done_.push_back(lease);
  if (rested(scheduler_.clock().now()) || done_.size() == limits::leases ||
      scheduler_.rarely(Buggify::Site::early_flush))
    flush();
  flush_when_idle();
}

/// Whether the oldest merged batch has waited for as long as it may.
bool LeaseClient::rested(Nanoseconds now) const {
  const Nanoseconds most = flush_interval(config_.flush_every, flush_cost_, lease_time_);
  return !done_.empty() && now - first_done_ >= most;
}

/// A loss of the moment: the batch is traced anew, the lease stands until its deadline. A loss that
/// lasts for as long as one waits for a lost node is for good: others may have the object.
void LeaseClient::lease_failed(uint64_t lease, int64_t batch) {
  ++counters_.leases_failed;
  if (over_) return;
  if (scheduler_.clock().now() - vain_since(lease, batch) < config_.lost)
    return photons_->add(lease, batch);
  ++counters_.leases_given_back;
  network_.send(config_.controller, network_.next_id(), LeasesFenced{{lease}});
  photons_->look_again();
  flush_when_idle();
}

/// Since when a batch has been traced in vain here, under whatever leases.
Nanoseconds LeaseClient::vain_since(uint64_t lease, int64_t batch) {
  const auto known = std::find_if(in_vain_.begin(), in_vain_.end(),
                                  [&](const InVain& vain) { return vain.batch == batch; });
  if (known != in_vain_.end()) {
    known->lease = lease;
    return known->since;
  }
  if (in_vain_.size() == limits::leases) in_vain_.erase(in_vain_.begin());
  return in_vain_.emplace_back(InVain{lease, batch, scheduler_.clock().now()}).since;
}

void LeaseClient::want_room() {
  room_wanted_ = true;
  flush();
}

/// Nothing more is to be had in this round: the controller waits for what is here.
void LeaseClient::flush_when_idle() {
  if ((round_empty_ || draining_) && photons_->at_hand() == 0) flush();
}

void LeaseClient::flush() {
  if (packing_ || flushing_ || over_ || done_.empty())
    return;  // the answer to that one sends the next
  flush_due_ = !encoder_is_free();
  if (flush_due_) return;
  room_wanted_ = false;
  packing_ = true;
  packed_leases_.swap(done_);
  const auto body = [this, totals = &photons_->give_totals()] { pack(*totals); };
  LUX_CHECK(scheduler_.fibers().start("flush", body), "the plan counts a fiber for it");
}

bool LeaseClient::encoder_is_free() const {
  return encoder_.use_count() == 1 && slices_.free();
}

/// On a fiber of its own, between the turns of the photon-threads.
void LeaseClient::pack(Totals& totals) {
  packing_took_ = 0;
  for (size_t slice = 0; slice < slices_.slices(); ++slice) {
    if (!pack_bins(slices_.encoder(slice), totals, slices_.bins_of(slice), FlushCounts::without))
      return;
  }
  if (!pack_bins(*encoder_, totals, slices_.own_bins(), FlushCounts::with)) return;
  const std::span<const std::byte> payload = encoder_->bytes();
  const uint64_t hash = XXH3_64bits(payload.data(), payload.size());  // as Hasher, in no memory
  packing_ = false;
  if (over_) return;
  flushing_ = Question{
      network_.next_id(), Flush{round_, hash, std::move(packed_leases_), {}}, {payload, encoder_}};
  if (config_.trace != nullptr)
    config_.trace->begin(TraceKind::flush, trace_id(flushing_->id), payload.size());
  ++counters_.flushes;
  counters_.flush_bytes += payload.size();
  slices_.send(flushing_->id, scheduler_.clock().now());
  put_flush();
  photons_->look_again();  // the totals that were packed are free
}

/// False: the node is to end.
bool LeaseClient::pack_bins(FlushEncoder& encoder, Totals& totals, const BinRange& bins,
                            FlushCounts counts) {
  encoder.begin(totals, bins, counts);
  for (bool done = false; !done;) {
    const Nanoseconds begun = scheduler_.clock().now();
    done = encoder.step(bins_of_a_step);
    packing_took_ += scheduler_.clock().now() - begun;
    if (!done && scheduler_.fibers().yield() == Wake::cancelled) return false;
  }
  return true;
}

/// For the first time when all slices are placed; then as often as no answer comes.
void LeaseClient::put_flush() {
  flushing_->asked = scheduler_.clock().now();
  if (!slices_.placed()) return;
  std::get<Flush>(flushing_->message).slice_hashes = slices_.hashes();
  put(*flushing_);
}

bool LeaseClient::shard_answered(const Delivery& delivery) {
  if (!slices_.deliver(delivery.source, delivery.id, delivery.message)) return false;
  if (flushing_ && flushing_->id == delivery.id && slices_.placed()) put_flush();
  return true;
}

void LeaseClient::flush_answered(const MessageId& answered, bool taken) {
  if (!flushing_ || flushing_->id != answered) return;
  const Nanoseconds answer_took = scheduler_.clock().now() - flushing_->asked;
  flush_cost_ = packing_took_ + answer_took;
  packed_leases_ = std::move(std::get<Flush>(flushing_->message).leases);  // its memory
  packed_leases_.clear();
  if (config_.trace != nullptr) config_.trace->end(TraceKind::flush, trace_id(answered), taken);
  flushing_.reset();
  if (!taken) ++counters_.flushes_refused;  // its leases are lent again: nothing to mend here
  flush_when_idle();
  if (room_wanted_) flush();
  photons_->look_again();
}

// ---- the end ---------------------------------------------------------------------------------

void LeaseClient::drain() {
  draining_ = true;
  flush_when_idle();
}

bool LeaseClient::drained() const {
  return !asking_ && !packing_ && !flushing_ && done_.empty() && photons_->at_hand() == 0;
}

void LeaseClient::say_goodbye() {
  network_.send(config_.controller, network_.next_id(), RequestLease{0});
}

void LeaseClient::stop_work(std::optional<Problem> fault) {
  if (std::exchange(over_, true)) return;
  fault_ = std::move(fault);
  asking_.reset();
  flushing_.reset();  // all is counted, or nothing more will be
  photons_->end();
}

void LeaseClient::end(std::optional<Problem> fault) {
  stop_work(std::move(fault));
  ended_ = true;
}

/// From the controller, which waits for an answer and lets all go when it has those of all; or from
/// a neighbour that was let go. A neighbour's word could be of an earlier run, which that neighbour
/// has outlived: until the controller has lent this node something it is but a rumour, which is
/// right if the controller never comes.
void LeaseClient::hear_of_end(NodeId from, const RunEnded& over) {
  end_word_ = over;
  rumour_ = from != config_.controller && counters_.leases == 0;
  if (rumour_) return;
  const auto says = [&] { return problem("the controller says: " + over.text); };
  stop_work(over.text.empty() ? std::nullopt : std::optional(says()));
  network_.send(config_.controller, network_.next_id(), RequestLease{0});
  if (from != config_.controller) let_go();
}

/// Neighbours are told first: with this node they may lose their way to the controller.
void LeaseClient::let_go() {
  stop_work(std::nullopt);
  if (tell_) return;
  tell_ = network_.neighbours();
  std::erase(*tell_, config_.controller);
  pass_on();
}

void LeaseClient::pass_on() {
  std::erase_if(*tell_, [&](NodeId neighbour) { return tell(neighbour) != SendOutcome::full; });
  if (tell_->empty()) return end(std::nullopt);
  scheduler_.timers().set(scheduler_.clock().now() + retry_after, [this] { pass_on(); });
}

SendOutcome LeaseClient::tell(NodeId neighbour) {
  return network_.send(neighbour, network_.next_id(), end_word_);
}

void LeaseClient::tell_end(NodeId neighbour) {
  if (tell_ && neighbour != config_.controller) (void)tell(neighbour);
}

void LeaseClient::watch_controller(Nanoseconds now) {
  if (ended_ || tell_) return;
  if (network_.reaches(config_.controller))
    unreachable_since_.reset();
  else if (!unreachable_since_)
    unreachable_since_ = now;
  const auto give_up = [&](const char* what, Nanoseconds after, const char* key) {
    if (rumour_) return end(std::nullopt);
    end(problem(fmt::format("{} for {:g} s ({})", what, static_cast<double>(after) * 1e-9, key)));
  };
  // Begun again after a crash the controller would ask anew who has heard of the end.
  const bool lost = unreachable_since_ && now - *unreachable_since_ >= config_.lost;
  if (over_) return lost ? end(std::nullopt) : void();
  if (!heard_ && now - began_ >= config_.start)
    give_up("the controller has not been heard of", config_.start, "start_s");
  else if (heard_ && lost)
    give_up("no way has led to the controller", config_.lost, "lost_s");
}

// ---- questions and answers -------------------------------------------------------------------

void LeaseClient::put(Question& question) {
  const SendOutcome outcome =
      network_.send(config_.controller, question.id, question.message, question.payload);
  question.asked = scheduler_.clock().now();
  question.left = outcome == SendOutcome::taken;
  if (question.left || retries_soon_) return;
  retries_soon_ = true;
  scheduler_.timers().set(question.asked + retry_after, [this] { retry(); });
}

/// What found no room or no way: nobody will answer it.
void LeaseClient::retry() {
  retries_soon_ = false;
  if (asking_ && !asking_->left) put(*asking_);
  if (flushing_ && !flushing_->left && slices_.placed()) put(*flushing_);
}

void LeaseClient::set_timer() {
  scheduler_.timers().set(scheduler_.clock().now() + config_.answer_patience / 4,
                          [this] { on_timer(); });
}

void LeaseClient::on_timer() {
  const Nanoseconds now = scheduler_.clock().now();
  for (std::optional<Question>* question : {&asking_, &flushing_}) {
    if (!*question || now - (*question)->asked < config_.answer_patience) continue;
    ++counters_.asked_again;
    question == &flushing_ ? put_flush() : put(**question);
  }
  if (flushing_) slices_.ask_again(now, config_.answer_patience);
  if (rested(now) || flush_due_) flush();
  if (round_empty_ && !over_ && now - emptied_ >= config_.answer_patience) begin_round();
  watch_controller(now);
  set_timer();
}

bool LeaseClient::deliver(const Delivery& delivery) {
  if (shard_answered(delivery)) return true;
  if (const auto* over = std::get_if<RunEnded>(&delivery.message)) {
    heard_ = heard_ || delivery.source == config_.controller;
    hear_of_end(delivery.source, *over);
    return true;
  }
  if (delivery.source != config_.controller) return false;
  heard_ = true;
  if (const auto* grant = std::get_if<LeaseGranted>(&delivery.message)) {
    granted(delivery.id, *grant);
  } else if (std::holds_alternative<FlushTaken>(delivery.message)) {
    flush_answered(delivery.id, true);
  } else if (std::holds_alternative<FlushRefused>(delivery.message)) {
    flush_answered(delivery.id, false);
  } else if (const auto* fenced = std::get_if<LeasesFenced>(&delivery.message)) {
    for (const uint64_t lease : fenced->leases) photons_->drop(lease);
  } else if (std::holds_alternative<RoundOpened>(delivery.message)) {
    begin_round();
  } else if (const auto* phase = std::get_if<EnterPhase>(&delivery.message)) {
    if (phase->phase == EndPhase::leave) let_go();
  } else {
    return false;
  }
  return true;
}

}  // namespace luxodus
