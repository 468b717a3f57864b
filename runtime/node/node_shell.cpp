#include "runtime/node/node_shell.hpp"

#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

/// Time between the end of a node's work and its leaving: messages about others' end still pass
/// through it.
constexpr Nanoseconds linger_time = milliseconds(100);
/// Interval of checks for changes from outside: short for a user who presses Ctrl-C, and long
/// enough that an idle node takes no CPU time from busy ones.
constexpr Nanoseconds look_every = milliseconds(50);

}  // namespace

/// The network as the scheduler's event source.
class NodeShell::Source final : public EventSource {
 public:
  Source(const Clock& clock, Network& network, Transport& transport)
      : clock_(clock), network_(network), transport_(transport) {}

  bool poll() override { return network_.poll(clock_.now()); }
  void send_out() override { network_.send_out(clock_.now()); }
  void wait_until(Nanoseconds deadline) override {
    transport_.wait_until(std::min(deadline, network_.next_deadline()));
  }
  void wake() noexcept override { transport_.wake(); }

 private:
  const Clock& clock_;
  Network& network_;
  Transport& transport_;
};

/// Delivers messages from the network to the node's actors.
class NodeShell::Handler final : public NetHandler {
 public:
  explicit Handler(NodeShell& shell) : shell_(shell) {}

  bool deliver(const Delivery& delivery) override {
    shell_.actors_.deliver(delivery);
    return true;
  }
  std::span<std::byte> room_for(const MessageId& id, NodeId, ActorPair actors,
                                size_t bytes) override {
    if (rarely(shell_.config_.net.buggify, Buggify::Site::no_room)) return {};
    return shell_.actors_.room_for(id, actors.to, bytes);
  }
  void abandoned(const MessageId& id, Kind) override { shell_.actors_.abandoned(id); }
  bool intercept(const Delivery& request) override { return shell_.actors_.intercept(request); }
  void link_changed(NodeId neighbour, LinkPhase phase) override {
    log_debug("link node={} neighbour={} phase={}", shell_.config_.net.self.value, neighbour.value,
              name_of(phase));
    if (phase != LinkPhase::up || !shell_.leaving_ || !shell_.tell_newcomer_) return;
    shell_.tell_newcomer_(neighbour);
    shell_.linger();
  }
  NextHops reroute(std::span<const Edge> down) override { return shell_.reroute_(down); }

 private:
  NodeShell& shell_;
};

NodeShell::NodeShell(const ShellConfig& config, Reroute reroute, const Clock& clock,
                     Transport& transport)
    : config_(config),
      reroute_(std::move(reroute)),
      clock_(clock),
      transport_(transport),
      handler_(std::make_unique<Handler>(*this)),
      network_(config.net, transport, *handler_, clock.now()),
      actors_(config.net.self, network_, config.max_payload_bytes),
      source_(std::make_unique<Source>(clock, network_, transport)),
      scheduler_(config.scheduler, clock, *source_),
      supervisor_(scheduler_, config.net.self) {}

NodeShell::~NodeShell() = default;

void NodeShell::begin(std::function<bool()> ended) {
  ended_ = std::move(ended);
  Shutdown& shutdown = scheduler_.shutdown();
  shutdown.add(scheduler_.end_all_fibers(config_.shutdown_phase));
  shutdown.add({"pass on farewells", config_.shutdown_phase, [this] { linger(); },
                [this] { return may_leave(); }, [] { return "others to hear of it"; }});
  shutdown.add({"leave", milliseconds(100), [this] { network_.say_bye(); }, [] { return true; },
                [] { return ""; }});
}

void NodeShell::linger() {
  left_at_ = clock_.now() + linger_time;
}

/// A neighbour in its handshake would wait for `start_s` if this node left silently.
bool NodeShell::may_leave() const {
  return clock_.now() >= left_at_ && !network_.meets_neighbour();
}

void NodeShell::leave_if_ended() {
  const bool fails = supervisor_.verdict().has_value();
  if (leaving_ || (!fails && !ended_())) return;
  leaving_ = true;
  scheduler_.shutdown().begin(fails ? supervisor_.verdict()->text : "the run has ended");
}

Nanoseconds NodeShell::turn() {
  const Nanoseconds due = scheduler_.turn();
  const bool stayed = !leaving_;
  leave_if_ended();
  if (stayed && leaving_) return clock_.now();
  return std::min(due, network_.next_deadline());
}

void NodeShell::run() {
  std::function<void()> look = [&] {
    leave_if_ended();
    if (!leaving_) scheduler_.timers().set(clock_.now() + look_every, [l = &look] { (*l)(); });
  };
  look();
  scheduler_.run();
}

}  // namespace luxodus
