#include "actors/view/live_cluster.hpp"

#include <algorithm>

#include "actors/supervise/node_plan.hpp"
#include "actors/tally/flush_codec.hpp"
#include "actors/view/edits_text.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// At leases and at work that begins, while something is traced, and while nothing is.
constexpr Nanoseconds look_at_work = milliseconds(1), look_at_rest = milliseconds(10);
/// How often whoever traces asks whether it shall stop.
constexpr std::chrono::milliseconds stop_every(5);
/// A worker has one lease in work and one that waits: the way to it and back takes no time.
constexpr size_t leases_each = 2;
/// A lease shall take about so long: short against what a person notices, long against a message.
constexpr Nanoseconds lease_at_least = milliseconds(20), lease_at_most = milliseconds(80);
constexpr int64_t max_batches = 256;
/// What large answers take to come is spread over more batches, within reason.
constexpr size_t large_answer = 256 << 10;
constexpr Nanoseconds large_answer_at_most = milliseconds(500);
/// A worker that has nothing to do so long after it was lent something has never got it.
constexpr Nanoseconds lost_on_the_way = seconds(1);
/// Until workers have heard of the end.
constexpr Nanoseconds farewell = milliseconds(300);

}  // namespace

/// What workers send to.
class LiveCluster::LiveCoordinator final
    : public NodeActor<LiveCoordinator,
                       ControlLane<Accepts<Letter<RequestLease>, 256, WhenFull::reject>,
                                   Accepts<Letter<BatchesTraced>, 256, WhenFull::reject>>,
                       DataLane<>> {
 public:
  LiveCoordinator(LiveCluster& cluster, NodeId self, NodeShell& shell)
      : NodeActor(shell.scheduler(), shell.actors(), {self, ActorName::coordinator}, "live"),
        cluster_(cluster) {
    shell.actors().add(ActorName::coordinator, *this);
  }

  void on(const Letter<RequestLease>& request) { cluster_.meet(request); }
  void on(const Letter<BatchesTraced>& traced) { cluster_.take(traced); }

  SendOutcome send(NodeId worker, const Message& message, SharedBytes payload = {}) {
    return tell({worker, ActorName::tracer}, message, std::move(payload));
  }

 private:
  LiveCluster& cluster_;
};

Result<std::unique_ptr<LiveCluster>> LiveCluster::start(const RunSetup& run, const Machine& machine,
                                                        const NodeSetup& node) {
  std::unique_ptr<LiveCluster> out(new LiveCluster(run, node));
  for (uint16_t i = 0; i < run.graph.workers(); ++i) out->peers_[{i}];
  LiveCluster& self = *out;
  out->thread_ = std::thread([&self, machine] { self.work(machine); });
  std::unique_lock lock(self.mutex_);
  self.changed_.wait(lock, [&] { return self.started_; });
  if (self.fault_) return *self.fault_;
  lock.unlock();
  return out;
}

LiveCluster::~LiveCluster() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  thread_.join();
}

// ---- whoever traces ----------------------------------------------------------------------------

void LiveCluster::foresee(const SceneEdits& edits) {
  const std::lock_guard lock(mutex_);
  foreseen_ = std::make_shared<const std::string>(edits_text(edits));
}

void LiveCluster::enter(const SceneEdits& edits) {
  const std::lock_guard lock(mutex_);
  edits_ = std::make_shared<const std::string>(edits_text(edits));
}

void LiveCluster::trace(LiveWork& work) {
  std::unique_lock lock(mutex_);
  work_ = &work;
  all_given_ = false;
  while (!work.stopped() && !(all_given_ && leases_.empty())) changed_.wait_for(lock, stop_every);
  // What is still out comes too late: the next call has it traced anew, if it is wanted then.
  for (const auto& [id, lease] : leases_) work.give_back(lease.batches);
  leases_.clear();
  work_ = nullptr;
}

std::optional<Problem> LiveCluster::fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

LiveCluster::Counters LiveCluster::counters() const {
  const std::lock_guard lock(mutex_);
  Counters out = counters_;
  for (const auto& [worker, peer] : peers_) out.workers += peer.here ? 1 : 0;
  return out;
}

// ---- the node's thread -------------------------------------------------------------------------

void LiveCluster::work(const Machine& machine) {
  const auto begun = [&](std::optional<Problem> fault) {
    const std::lock_guard lock(mutex_);
    started_ = true;
    fault_ = std::move(fault);
    changed_.notify_all();
  };
  try {
    NodeTransport transport(machine, node_);
    NodeShell shell({controller_net(run_, node_), controller_limits(node_),
                     ShellConfig{}.max_payload_bytes, node_.shutdown_phase, run_.routes},
                    run_.graph, machine.clock, transport.transport());
    if (auto joined = join_links(transport.sockets(), node_); !joined)
      return begun(joined.problem());
    LiveCoordinator coordinator(*this, node_.net.self, shell);
    shell_ = &shell;
    coordinator_ = &coordinator;
    last_lease_ = node_.net.incarnation.value;  // no lease of an earlier life is taken for one
    begun(std::nullopt);
    look();
    Nanoseconds told = never;
    shell.begin([&] {
      const std::lock_guard lock(mutex_);
      if (!ends_) return false;
      const Nanoseconds now = machine.clock.now();
      if (told == never) {
        told = now;
        say_end();
      }
      return now >= told + farewell;
    });
    shell.run();
  } catch (const std::exception& e) {
    log_error("view=broken text=\"{}\"", e.what());
    begun(problem(e.what()));
  }
}

void LiveCluster::say_end() {
  for (const auto& [worker, peer] : peers_)
    if (peer.here) coordinator_->send(worker, RunEnded{});
}

void LiveCluster::look() {
  const std::lock_guard lock(mutex_);
  Scheduler& scheduler = shell_->scheduler();
  const Nanoseconds now = scheduler.clock().now();
  scheduler.timers().set(now + (work_ == nullptr ? look_at_rest : look_at_work),
                         [this] { look(); });
  for (auto& [worker, peer] : peers_) {
    if (!peer.here || shell_->network().reaches(worker)) continue;
    peer.here = false;
    log_warning("worker=lost node={} text=\"no way leads to {}\"", worker.value,
                run_.name_of(worker));
  }
  fence([&](const Lease& lease) { return !peers_[lease.node].here; }, "its worker is gone");
  fence([&](const Lease& lease) { return now - lease.lent >= node_.lease_time; }, "late");
  note_refusal();
  tell_foreseen();
  lend_all();
}

/// Whoever has had workers waits for them; whoever is turned away at first would wait for ever.
void LiveCluster::note_refusal() {
  const auto met = [](const auto& entry) { return entry.second.life != Incarnation{}; };
  if (fault_ || std::any_of(peers_.begin(), peers_.end(), met)) return;
  const Network& network = shell_->network();
  const auto taken = network.taken_elsewhere();
  if (!taken) return;
  fault_ = problem(
      "the live view has nobody to trace for it, since its workers are not free: let "
      "the run that " +
      run_.name_of(*taken) + " works for end first, or give this view other workers; " +
      network.refusal_of(*taken));
}

/// A lease of no batches has a worker compile what it refers to, and gets no answer.
void LiveCluster::tell_foreseen() {
  if (!foreseen_) return;
  for (const auto& [worker, peer] : peers_)
    if (peer.here) send(worker, {.lease = ++last_lease_}, foreseen_);
  foreseen_.reset();
}

SendOutcome LiveCluster::send(NodeId worker, const TraceBatches& order,
                              const std::shared_ptr<const std::string>& edits) {
  return coordinator_->send(worker, order, {std::as_bytes(std::span(*edits)), edits});
}

template <class Which>
void LiveCluster::fence(Which&& which, const char* why) {
  for (auto at = leases_.begin(); at != leases_.end();) {
    if (!which(at->second)) {
      ++at;
      continue;
    }
    ++counters_.fenced;
    log_warning("lease=fenced lease={} node={} text=\"{}: lent again\"", at->first,
                at->second.node.value, why);
    work_->give_back(at->second.batches);
    all_given_ = false;
    at = leases_.erase(at);
  }
}

size_t LiveCluster::lent_to(NodeId worker) const {
  return static_cast<size_t>(std::count_if(leases_.begin(), leases_.end(), [&](const auto& entry) {
    return entry.second.node == worker;
  }));
}

void LiveCluster::lend_all() {
  for (auto& [worker, peer] : peers_)
    if (peer.here) lend(worker, peer);
  if (all_given_ && leases_.empty()) changed_.notify_all();
}

/// So many that all leases of all workers end together.
int64_t LiveCluster::fair_share() const {
  int64_t leases = 0;
  for (const auto& [worker, peer] : peers_)
    if (peer.here) leases += static_cast<int64_t>(leases_each);
  return std::max<int64_t>(1, work_->left() / std::max<int64_t>(leases, 1));
}

void LiveCluster::lend(NodeId worker, Peer& peer) {
  if (work_ == nullptr) return;
  for (size_t lent = lent_to(worker); lent < leases_each; ++lent) {
    const auto batches = work_->next(std::min(peer.batches, fair_share()));
    all_given_ = !batches;
    if (!batches) return;
    const TraceBatches order{++last_lease_,
                             work_->seed(),
                             static_cast<uint32_t>(batches->group),
                             static_cast<uint32_t>(batches->count),
                             static_cast<uint64_t>(batches->first),
                             static_cast<uint32_t>(batches->stream)};
    if (send(worker, order, edits_) != SendOutcome::taken) {
      work_->give_back(*batches);
      return;
    }
    leases_[order.lease] = {worker, *batches, shell_->scheduler().clock().now()};
    ++counters_.leases;
  }
}

/// A worker says that it is there, and has nothing to do.
void LiveCluster::meet(const Letter<RequestLease>& request) {
  const std::lock_guard lock(mutex_);
  const NodeId worker = request.from.node;
  const auto known = peers_.find(worker);
  if (known == peers_.end()) return;
  shell_->actors().send(coordinator_->address(), request.from, request.id,
                        ends_ ? Message(RunEnded{}) : Message(LeaseGranted{}));
  if (ends_) return;
  Peer& peer = known->second;
  const Incarnation life = request.id.incarnation;
  const bool anew = peer.life != life;
  if (!peer.here)
    log_info("worker=here node={} text=\"{} is there\"", worker.value, run_.name_of(worker));
  const Nanoseconds now = shell_->scheduler().clock().now();
  fence(
      [&](const Lease& lease) {
        return lease.node == worker && (anew || now - lease.lent >= lost_on_the_way);
      },
      "its worker has nothing to do");
  peer = {true, life, anew ? 1 : peer.batches};
  lend(worker, peer);
}

void LiveCluster::take(const Letter<BatchesTraced>& traced) {
  const std::lock_guard lock(mutex_);
  const NodeId worker = traced.from.node;
  const auto known = peers_.find(worker);
  if (known == peers_.end()) return;
  Peer& peer = known->second;
  const auto at = leases_.find(traced.body.lease);
  if (at == leases_.end() || at->second.node != worker || peer.life != traced.id.incarnation) {
    ++counters_.dropped;
    return;
  }
  const Lease lease = at->second;
  Totals& totals = work_->totals();
  const auto gain =
      traced.body.fault.empty()
          ? decode_flush(traced.payload.bytes(), totals.groups(), totals.layout().totals())
          : Result<FlushGain>(problem(traced.body.fault));
  if (!gain || gain.value().batches() != lease.batches.count) {
    log_error("worker=fails node={} text=\"{}: {}\"", worker.value, run_.name_of(worker),
              gain.ok() ? "other batches than it was lent" : gain.problem().what);
    peer.here = false;  // until it says again that it is
    fence([&](const Lease& its) { return its.node == worker; }, "its worker fails");
    return;
  }
  gain.value().add_to(totals);
  leases_.erase(at);
  const Nanoseconds took = shell_->scheduler().clock().now() - lease.lent;
  const bool large = traced.payload.bytes().size() >= large_answer;
  if (took < (large ? large_answer_at_most : lease_at_least))
    peer.batches = std::min(2 * peer.batches, max_batches);
  else if (took > lease_at_most && !large)
    peer.batches = std::max<int64_t>(peer.batches / 2, 1);
  lend(worker, peer);
  if (all_given_ && leases_.empty()) changed_.notify_all();
}

}  // namespace luxodus
