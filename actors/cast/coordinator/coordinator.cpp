#include "actors/cast/coordinator/coordinator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "actors/cast/names/role.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Late leases may be close together; a look examines more than one of them.
constexpr Nanoseconds min_between_looks = milliseconds(20);
/// Pause before sending again after the network had no room.
constexpr Nanoseconds say_again_after = milliseconds(20);
}  // namespace

Coordinator::Coordinator(const CoordinatorConfig& config, const CompiledScene& scene,
                         LeaseBook book, Scheduler& scheduler, Network& network, Sender& sender)
    : NodeActor(scheduler, sender, {config.self, role::coordinator}, "tally"),
      config_(config),
      scene_(scene),
      network_(network),
      book_(std::move(book)),
      clock_(scheduler.clock()) {
  for (const NodeId worker : config_.workers) {
    peers_.emplace(worker, end_timer(worker));
    tracers_ += tracers_of(worker);
  }
  for (const NodeId orphan : config_.orphans)
    peers_.try_emplace(orphan, end_timer(orphan)).first->second.expected = false;
  untold_.reserve(peers_.size());
  uncounted_.reserve(2 * peers_.size());
}

void Coordinator::start() {
  NodeActor::start();
  set_timer();
}

// ---- arrival and loss of workers ---------------------------------------------------------------

/// Registers a worker and its incarnation. Returns false for a message of an incarnation that has
/// ended.
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
      life_ended(worker.node, peer.life);
      worker_gone(worker.node, "began anew");
    }
    peer.life = life;
    peer.told.reset();
    peer.telling = end_timer(worker.node);
    peer.left = peer.idle = false;
  }
  if (!std::exchange(peer.here, true)) worker_came(worker.node);
  const auto here = [](const auto& entry) { return entry.second.here || !entry.second.expected; };
  if (!begun_ && !over_ && std::all_of(peers_.begin(), peers_.end(), here)) all_are_here();
  return true;
}

std::string Coordinator::name_of(NodeId node) const {
  return node.value < config_.names.size() ? config_.names[node.value]
                                           : fmt::format("node {}", node.value);
}

void Coordinator::watch_workers(Nanoseconds now) {
  for (auto& [worker, peer] : peers_) {
    if (network_.reaches(worker)) {
      peer.unreachable_since.reset();
      continue;
    }
    peer.told.reset();  // it may restart meanwhile
    if (!peer.unreachable_since) peer.unreachable_since = now;
    if (!(begun_ || over_) || !peer.here || !is_lost(peer)) continue;
    peer.here = false;
    ++counters_.workers_lost;
    const std::string since =
        config_.lost > 0 ? fmt::format(" for {:g} s", seconds_in(config_.lost)) : "";
    log_error("worker=lost node={} text=\"no way has led to {}{}: its batches are lent again\"",
              worker.value, name_of(worker), since);
    fence(book_.fence_node(worker), "its worker is lost");
    worker_gone(worker, "is lost");
  }
  workers_watched();
}

void Coordinator::fence(const std::vector<Lease>& leases, const char* why) {
  for (const Lease& lease : leases)
    log_warning("lease=fenced lease={} node={} batch={} text=\"{}: lent again\"", lease.id,
                lease.node.value, lease.batch, why);
  tell_fenced(leases);
  if (!leases.empty()) offer_batches();
}

/// Sends each node as few messages as possible: hundreds of leases may be fenced at once, and one
/// message for each would leave no room for answers that others await.
void Coordinator::tell_fenced(const std::vector<Lease>& leases) {
  counters_.fenced += leases.size();
  std::map<NodeId, LeasesFenced> told;
  for (const Lease& lease : leases) {
    LeasesFenced& of_node = told[lease.node];
    of_node.leases.push_back(lease.id);
    if (of_node.leases.size() < limits::leases) continue;
    send(lease.node, sender().next_id(), of_node);
    of_node.leases.clear();
  }
  for (const auto& [node, fenced] : told)
    if (!fenced.leases.empty()) send(node, sender().next_id(), fenced);
}

/// A worker that got no batch would ask again only after its retry time, which is too late for
/// batches that have become available since. As many workers are told as there are batches:
/// otherwise all but these would ask in vain. Each look tells as many others, in turn, and again
/// those that do not come.
void Coordinator::offer_batches() {
  if (!begun_ || over_) return;
  const RoundOpened more{round(), static_cast<uint64_t>(book_.end()), state()};
  int64_t batches = book_.waiting();
  auto at = last_grant_.upper_bound(last_offered_);
  for (size_t tried = 0; batches > 0 && tried < last_grant_.size(); ++tried, ++at) {
    if (at == last_grant_.end()) at = last_grant_.begin();
    auto& [worker, last] = *at;
    if (!last.offer.may_ask(clock_.now())) continue;
    if (std::get<LeaseGranted>(last.answer).batches > 0) continue;
    if (!peers_.at(worker).traces() || !network_.reaches(worker)) continue;
    if (send(worker, sender().next_id(), more) != SendOutcome::taken) continue;
    last.offer.asked(clock_.now());
    last_offered_ = worker;
    --batches;
  }
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
  metrics.add_counter({"flush_in", "bytes", "Bytes of flushes that came.", ""}, c.flush_bytes);
  metrics.add_counter({"batches_counted", "", "Batches counted.", ""}, c.batches);
  metrics.add_counter({"particles_counted", "", "Particles of batches counted.", ""}, c.particles);
  metrics.add_gauge({"leases_out", "", "Leases that stand.", ""}, c.leases_out);
}

void Coordinator::note_book() {
  counters_.batches = static_cast<uint64_t>(book_.committed());
  counters_.leases_out = book_.standing();
  counters_.particles = counters_.batches * static_cast<uint64_t>(scene_.batch_particles);
}

// ---- leases ----------------------------------------------------------------------------------

uint32_t Coordinator::tracers_of(NodeId worker) const {
  return worker.value < config_.below.size() ? config_.below[worker.value].tracers : 1;
}

/// Whether a question is an old copy of one before the last of its kind: its sender has moved on.
bool Coordinator::is_older(const MessageId& question, const MessageId& last) {
  return question.incarnation == last.incarnation && question.sequence < last.sequence;
}

uint32_t Coordinator::levels_below(NodeId worker) const {
  return worker.value < config_.below.size() ? config_.below[worker.value].levels : 0;
}

/// A node that coordinates others first waits for their late leases, so it has more time.
Nanoseconds Coordinator::span_of(NodeId worker) const {
  return config_.lease_time << (2 * levels_below(worker));
}

/// No worker gets more than its share of what is left, so that all finish together.
uint32_t Coordinator::max_to_lend(NodeId worker) const {
  if (scheduler().rarely(Buggify::Site::small_grant)) return 1;
  const int64_t own = tracers_of(worker), all = std::max<int64_t>(tracers_, 1);
  const int64_t share = (book_.waiting() * own + all - 1) / all;
  return static_cast<uint32_t>(std::clamp<int64_t>(share, 1, config_.max_leases * own));
}

LeaseGranted Coordinator::grant_of(NodeId worker, const LentBatches& lent) const {
  constexpr Nanoseconds longest = milliseconds(std::numeric_limits<uint32_t>::max());
  const auto span_ms = static_cast<uint32_t>(std::min(span_of(worker), longest) / milliseconds(1));
  return {lent.first_lease,
          round(),
          static_cast<uint64_t>(lent.first_batch),
          static_cast<uint32_t>(lent.count),
          span_ms,
          state()};
}

void Coordinator::on(const Letter<RequestLease>& request) {
  const NodeId worker = request.from.node;
  if (!meet(request.from, request.id.incarnation)) return;
  Answered& last = last_grant_[worker];
  if (is_older(request.id, last.question)) return;
  const uint32_t batches = request.body.batches;
  if (over_ && batches > 0) return answer_with_end(request);
  if (over_) {
    Peer& peer = peers_.at(worker);
    peer.told = clock_.now();
    peer.telling.answered(*peer.told);
    return farewell_heard();
  }
  if (last.question != request.id) {
    Peer& peer = peers_.at(worker);
    peer.left = false;
    peer.idle = batches == 0;
    last = {request.id, grant_of(worker, lend(worker, batches))};
  }
  answer(request, last.answer);
  lent();
}

/// A worker has joined another coordinator, which will tell it of the end, or leaves before the
/// end.
void Coordinator::on(const Letter<EnterPhase>& leave) {
  const NodeId worker = leave.from.node;
  if (leave.body.phase != EndPhase::leave || !meet(leave.from, leave.id.incarnation)) return;
  Answered& last = last_grant_[worker];
  if (is_older(leave.id, last.question)) return;
  peers_.at(worker).left = true;
  if (over_) return farewell_heard();
  if (last.question != leave.id) last = {leave.id, grant_of(worker, lend(worker, 0))};
  answer(leave, last.answer);
  lent();
}

/// A request for no batches returns all leases of the worker.
LentBatches Coordinator::lend(NodeId worker, uint32_t batches) {
  if (batches == 0) {
    fence(book_.fence_node(worker), "its worker returns it");
    return {};
  }
  const LentBatches lent = book_.lend(worker, std::min(batches, max_to_lend(worker)), clock_.now(),
                                      span_of(worker), rank_of(worker));
  counters_.leases += static_cast<uint64_t>(lent.count);
  note_book();
  return lent;
}

/// A worker has failed on these for the lost-node timeout: it cannot obtain an object.
void Coordinator::on(const Letter<LeasesFenced>& given_back) {
  const NodeId worker = given_back.from.node;
  if (!meet(given_back.from, given_back.id.incarnation)) return;
  for (const Lease& lease : book_.give_back(worker, given_back.body.leases))
    log_warning(
        "lease=given_back lease={} node={} batch={} text=\"{} cannot have an object that it needs: "
        "lent to others\"",
        lease.id, worker.value, lease.batch, name_of(worker));
  offer_batches();
}

// ---- the end ---------------------------------------------------------------------------------

// End of a run. If this node left before a worker has heard of the end, that worker would wait for
// `lost` and take a successful run for a failed one; and if workers left as soon as they have
// heard, nodes behind them would be cut off. So all stay until each has answered or is lost: an
// unreachable worker gives up by itself after the same time. A worker forgets the end when it
// crashes, so all are told repeatedly until each has answered recently.
// Then all are released, and tell their neighbours as they leave. An interrupted run waits for no
// unreachable worker.

void Coordinator::end_work() {
  over_ = true;
  over_since_ = clock_.now();
  go_on_counting();  // pending flushes are refused
}

/// Workers that the network had no room for come first next time; otherwise a full outbox would
/// keep the end from the same workers each time.
void Coordinator::tell_end() {
  if (keeps_end_to_itself()) return;
  before_end_is_told();
  for (const auto& [worker, peer] : peers_) {
    if (!is_told(peer) || !peer.telling.may_remind(clock_.now())) continue;
    if (std::count(untold_.begin(), untold_.end(), worker) == 0) untold_.push_back(worker);
  }
  tell_untold();
}

void Coordinator::tell_end_anew() {
  for (auto& [worker, peer] : peers_) peer.telling = end_timer(worker);
  tell_end();
}

/// A node that leads others answers only after all of them know: it is asked at each look, to hear
/// from it soon. There are few such nodes.
RetryTimer Coordinator::end_timer(NodeId worker) const {
  return {config_.look_every / 2, levels_below(worker) > 0 ? config_.look_every / 2 : config_.lost};
}

/// Repeats until the network has taken the message for each.
void Coordinator::tell_untold() {
  std::erase_if(untold_, [&](NodeId worker) {
    const SendOutcome outcome = send(worker, sender().next_id(), end_word());
    if (outcome == SendOutcome::taken) peers_.at(worker).telling.asked(clock_.now());
    return outcome != SendOutcome::full;
  });
  if (untold_.empty() || telling_) return;
  telling_ = true;
  scheduler().timers().set(clock_.now() + say_again_after, own_task([this] {
                             telling_ = false;
                             tell_untold();
                           }));
}

/// A worker that still asks for work has restarted since it was told. An answer without batches
/// would make it wait for the next round, from a controller that may leave before it can send more.
void Coordinator::answer_with_end(const Letter<RequestLease>& request) {
  if (keeps_end_to_itself()) {
    answer(request, grant_of(request.from.node, {}));
    return;
  }
  answer(request, end_word());
  peers_.at(request.from.node).telling.asked(clock_.now());
  if (letting_go_) tell(request.from, EnterPhase{EndPhase::leave, 0});
}

/// A worker that was never heard may still wait for the end, if it was led by an earlier
/// incarnation.
bool Coordinator::is_told(const Peer& peer) const {
  return peer.here || (peer.expected && tells_all());
}

bool Coordinator::is_lost(const Peer& peer) const {
  return peer.unreachable_since && clock_.now() - *peer.unreachable_since >= config_.lost;
}

bool Coordinator::knows_end(NodeId worker, const Peer& peer) const {
  if (peer.left || !is_told(peer)) return true;
  if (!network_.reaches(worker)) return hurries() || (!peer.here && is_lost(peer));
  return peer.told && clock_.now() - *peer.told <= is_fresh_for(peer);
}

/// An answer counts for three intervals of telling.
Nanoseconds Coordinator::is_fresh_for(const Peer& peer) const {
  return 3 * std::max(config_.look_every, peer.telling.rest());
}

Nanoseconds Coordinator::word_is_fresh() const {
  Nanoseconds longest = 0;
  for (const auto& [worker, peer] : peers_) longest = std::max(longest, is_fresh_for(peer));
  return longest;
}

bool Coordinator::all_know_end() const {
  return std::all_of(peers_.begin(), peers_.end(),
                     [&](const auto& entry) { return knows_end(entry.first, entry.second); });
}

/// Repeats until the network has taken the message for each worker that it can reach.
void Coordinator::let_go() {
  letting_go_ = true;
  const EnterPhase leave{EndPhase::leave, 0};
  for (auto& [worker, peer] : peers_)
    if (!peer.gone)
      peer.gone = (!peer.here && !peer.expected) ||
                  send(worker, sender().next_id(), leave) != SendOutcome::full;
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

// ---- timers ----------------------------------------------------------------------------------

/// Fires after `look_every`, or as soon as a lease is late.
void Coordinator::set_timer() {
  const Nanoseconds now = clock_.now();
  Nanoseconds next = now + config_.look_every;
  if (const auto late = book_.next_deadline(); late && !over_)
    next = std::min(next, std::max(*late, now + min_between_looks));
  scheduler().timers().set(next, own_task([this] {
                             look();
                             set_timer();
                           }));
}

void Coordinator::look() {
  const Nanoseconds now = clock_.now();
  watch_workers(now);
  if (over_) return wait_for_farewells(now);
  look_at_work(now);
  offer_batches();
}

/// If there is no room or no route, the worker asks again, or look() repeats the message.
SendOutcome Coordinator::send(NodeId worker, const MessageId& id, const Message& message) {
  return sender().send(address(), {worker, role::tracer}, id, message);
}

}  // namespace luxodus
