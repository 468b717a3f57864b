#include "actors/cast/coordinator/state_coordinator.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "runtime/core/log.hpp"

namespace luxodus {

namespace {
/// Time for workers to hear of the end; after it, the others give this node up by themselves.
constexpr Nanoseconds farewell = seconds(1);
}  // namespace

StateCoordinator::StateCoordinator(const CoordinatorConfig& config, const CompiledScene& first,
                                   std::function<void()> done, Scheduler& scheduler,
                                   Network& network, Sender& sender)
    : Coordinator(config, first, LeaseBook(0, {}, config.first_lease), scheduler, network, sender),
      done_(std::move(done)) {}

void StateCoordinator::start() {
  begun_ = true;
  Coordinator::start();
}

// ---- states -------------------------------------------------------------------------------------

void StateCoordinator::foresee(const StateObject& state) {
  foreseen_ = {state, state.id()};
  const RoundOpened next{round(), 0, foreseen_->id};
  for (const auto& [worker, peer] : peers_)
    if (peer.here) send(worker, sender().next_id(), next);
}

void StateCoordinator::enter(const StateObject& state) {
  if (state_ && state_->object == state) return;
  state_ = {state, state.id()};
  stuck_ = 0;
  ++counters_.round;
}

const StateObject* StateCoordinator::known(ObjectId id) const {
  if (state_ && state_->id == id) return &state_->object;
  if (foreseen_ && foreseen_->id == id) return &foreseen_->object;
  return nullptr;
}

void StateCoordinator::on(const Letter<AskState>& ask) {
  const StateObject* const state = known(ask.body.state);
  const auto bytes = std::make_shared<const std::string>(state == nullptr ? "" : state->bytes());
  sender().send(address(), ask.from, ask.id, StateTold{ask.body.state},
                {std::as_bytes(std::span(*bytes)), bytes});
}

// ---- work ---------------------------------------------------------------------------------------

void StateCoordinator::begin(Work& work) {
  work_ = &work;
  all_given_ = false;
  fill_book();
  offer_batches();
  end_when_done();
}

/// Keeps as many batches here as all tracing nodes may ask for at once, so that none waits for the
/// work.
void StateCoordinator::fill_book() {
  if (work_ == nullptr || over_) return;
  const auto tracing = static_cast<size_t>(std::count_if(
      peers_.begin(), peers_.end(), [](const auto& at) { return at.second.traces(); }));
  const auto wish = static_cast<int64_t>(config_.max_leases * std::max<size_t>(tracing, 1));
  while (!all_given_ && book_.waiting() < wish) {
    const auto batches = work_->next(wish - book_.waiting());
    all_given_ = !batches;
    if (!batches) return;
    const int64_t first = number_of(*batches);
    for (int64_t number = first; number < first + batches->count; ++number) {
      book_.add(number);
      out_.insert(number);
    }
  }
}

void StateCoordinator::give_back(const std::set<int64_t>& batches) {
  for (auto at = batches.begin(); at != batches.end();) {
    BatchRange row = batch_of(*at);
    for (int64_t next = *at + 1; ++at != batches.end() && *at == next; ++next) ++row.count;
    work_->give_back(row);
  }
}

void StateCoordinator::stop() {
  if (work_ == nullptr) return;
  std::set<int64_t> kept = out_;
  tell_fenced(book_.remove(kept));
  std::set<int64_t> back;
  std::set_difference(out_.begin(), out_.end(), kept.begin(), kept.end(),
                      std::inserter(back, back.end()));
  give_back(back);
  out_ = std::move(kept);
  all_given_ = true;
  end_when_done();
}

void StateCoordinator::counted(const Letter<Flush>&, std::span<const int64_t> batches) {
  stuck_ = 0;
  for (const int64_t batch : batches) out_.erase(batch);
  if (work_ != nullptr) work_->merged(static_cast<int64_t>(batches.size()));
  end_when_done();
}

void StateCoordinator::end_when_done() {
  if (work_ == nullptr || !all_given_ || !out_.empty()) return;
  work_ = nullptr;
  done_();
}

/// Batches that no present node can trace are leased again at the next look: others may have
/// joined.
void StateCoordinator::take_back_lost() {
  std::vector<NodeId> here;
  for (const auto& [worker, peer] : peers_)
    if (peer.traces()) here.push_back(worker);
  if (here.empty() || book_.lose_what_all_gave_back(here) == 0) return;
  const std::set<int64_t> lost = book_.take_lost();
  ++stuck_;
  log_error("state=stuck batches={} text=\"none of the nodes can enter this state of the scene\"",
            lost.size());
  give_back(lost);
  for (const int64_t batch : lost) out_.erase(batch);
  all_given_ = false;
}

void StateCoordinator::look_at_work(Nanoseconds now) {
  fence(book_.fence_late(now), "late");
  note_book();
  note_refusal();
  if (work_ == nullptr) return;
  take_back_lost();
  fill_book();
  end_when_done();
}

size_t StateCoordinator::workers_here() const {
  return static_cast<size_t>(
      std::count_if(peers_.begin(), peers_.end(), [](const auto& at) { return at.second.here; }));
}

void StateCoordinator::worker_came(NodeId worker) {
  log_info("worker=here node={} text=\"{} is there\"", worker.value, name_of(worker));
}

/// A node that has had workers waits for them; one whose workers refuse from the start gives up.
void StateCoordinator::note_refusal() {
  const auto met = [](const auto& at) { return at.second.life != Incarnation{}; };
  if (fault_ || std::any_of(peers_.begin(), peers_.end(), met)) return;
  const auto taken = network_.taken_elsewhere();
  if (!taken) return;
  fault_ = problem(
      "the live view has nobody to trace for it, since its workers are not free: let "
      "the run that " +
          name_of(*taken) + " works for end first, or give this view other workers; " +
          network_.refusal_of(*taken),
      ProblemKind::refused);
}

// ---- the end ------------------------------------------------------------------------------------

void StateCoordinator::end() {
  if (over_) return;
  stop();
  end_work();
  tell_end();
}

void StateCoordinator::wait_for_farewells(Nanoseconds) {
  tell_end();
  leave_when_told();
}

void StateCoordinator::leave_when_told() {
  if (!letting_go_ && (all_know_end() || over_for() >= farewell)) let_go();
}

}  // namespace luxodus
