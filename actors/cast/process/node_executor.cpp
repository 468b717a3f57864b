#include "actors/cast/process/node_executor.hpp"

#include <utility>

#include "actors/cast/node/state_node.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// How often trace() checks whether it should stop.
constexpr std::chrono::milliseconds stop_every(5);

}  // namespace

Result<std::unique_ptr<NodeExecutor>> NodeExecutor::start(const RunSetup& run,
                                                          const Machine& machine,
                                                          const NodeSetup& node) {
  std::unique_ptr<NodeExecutor> out(new NodeExecutor(run, node));
  NodeExecutor& self = *out;
  out->thread_ = std::thread([&self, machine] { self.work(machine); });
  std::unique_lock lock(self.mutex_);
  self.changed_.wait(lock, [&] { return self.started_; });
  if (!self.state_) return self.state_.problem();
  lock.unlock();
  return out;
}

NodeExecutor::~NodeExecutor() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    ask_node();
  }
  thread_.join();
}

// ---- the caller's thread -----------------------------------------------------------------------

/// The node's thread also checks by itself: if the handoff is full, a little later.
void NodeExecutor::ask_node() {
  if (shell_ != nullptr) (void)shell_->scheduler().handoff().give([this] { do_what_is_wished(); });
}

void NodeExecutor::foresee(const StateObject& state) {
  const std::lock_guard lock(mutex_);
  foreseen_ = state;
  ask_node();
}

void NodeExecutor::enter(const StateObject& state) {
  const std::lock_guard lock(mutex_);
  entered_ = state;
  ask_node();
}

void NodeExecutor::trace(Work& work) {
  std::unique_lock lock(mutex_);
  next_ = &work;
  stops_ = false;
  tracing_ = true;
  ask_node();
  // If its node is gone, nothing more arrives; the caller learns that from fault().
  while (tracing_ && !(shell_ == nullptr && work.stopped())) {
    changed_.wait_for(lock, stop_every);
    if (!tracing_ || stops_ || !work.stopped()) continue;
    stops_ = true;
    ask_node();
  }
  tracing_ = false;
  next_ = nullptr;
}

Result<void> NodeExecutor::goes_on() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

NodeExecutor::Counters NodeExecutor::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

// ---- the node's thread --------------------------------------------------------------------------

void NodeExecutor::begun(Result<void> outcome) {
  const std::lock_guard lock(mutex_);
  started_ = true;
  if (!outcome) state_ = std::move(outcome);
  changed_.notify_all();
}

/// While it exists, the caller's thread can reach the node.
class NodeExecutor::Door {
 public:
  Door(NodeExecutor& executor, StateNode& node) : executor_(executor) {
    const std::lock_guard lock(executor_.mutex_);
    executor_.shell_ = &node.shell();
    executor_.coordinator_ = &node.coordinator();
  }
  ~Door() {
    const std::lock_guard lock(executor_.mutex_);
    executor_.shell_ = nullptr;
    executor_.coordinator_ = nullptr;
    executor_.changed_.notify_all();
  }
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;

 private:
  NodeExecutor& executor_;
};

void NodeExecutor::work(const Machine& machine) {
  try {
    NodeTransport transport(machine, node_);
    StateNode node(run_, node_, transport.seams(), [this] {
      const std::lock_guard lock(mutex_);
      tracing_ = false;
      changed_.notify_all();
    });
    if (auto joined = join_links(transport.sockets(), node_); !joined)
      return begun(joined.problem());
    node.start([this] { do_what_is_wished(); });
    const Door door(*this, node);
    begun({});
    node.shell().run();
    const auto& verdict = node.shell().supervisor().verdict();
    begun(verdict ? problem(verdict->text, ProblemKind::system) : Result<void>());
  } catch (const std::exception& e) {
    log_error("view=broken text=\"{}\"", e.what());
    begun(problem(e.what(), ProblemKind::system));
  }
}

/// In the order in which requests may have been made.
void NodeExecutor::do_what_is_wished() {
  const std::lock_guard lock(mutex_);
  if (coordinator_ == nullptr) return;
  if (foreseen_) coordinator_->foresee(*std::exchange(foreseen_, std::nullopt));
  if (entered_ && !coordinator_->working())
    coordinator_->enter(*std::exchange(entered_, std::nullopt));
  if (next_ != nullptr) coordinator_->begin(*std::exchange(next_, nullptr));
  if (stops_ && tracing_) coordinator_->stop();
  if (ends_) coordinator_->end();
  note(*coordinator_);
}

void NodeExecutor::note(const StateCoordinator& coordinator) {
  const Coordinator::Counters& c = coordinator.counters();
  counters_ = {c.leases, c.fenced, c.flushes_refused, coordinator.workers_here(),
               coordinator.stuck()};
  if (state_ && coordinator.fault()) state_ = *coordinator.fault();
}

}  // namespace luxodus
