// The common parts of a node: clock, network, scheduler, its actor system, and their supervisor.
// The actors that are added make it what it is. It is run by one OS thread, or by a simulation turn
// by turn. Thread rule: made and run on one thread; wake() from any.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "runtime/actor/scheduler.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "runtime/node/supervisor.hpp"

namespace luxodus {

/// Next hops without these links: see NetHandler::reroute.
using Reroute = std::function<NextHops(std::span<const Edge> down)>;

struct ShellConfig {
  NetConfig net;
  SchedulerLimits scheduler;
  size_t max_payload_bytes = 1 << 30;       // of messages that wait in mailboxes
  Nanoseconds shutdown_phase = seconds(5);  // for each phase of its shutdown
};

class NodeShell {
 public:
  /// Requires: clock and transport outlive this.
  NodeShell(const ShellConfig& config, Reroute reroute, const Clock& clock, Transport& transport);
  ~NodeShell();

  Scheduler& scheduler() { return scheduler_; }
  const Scheduler& scheduler() const { return scheduler_; }
  Network& network() { return network_; }
  ActorSystem& actors() { return actors_; }
  Supervisor& supervisor() { return supervisor_; }
  const Supervisor& supervisor() const { return supervisor_; }

  /// `ended` is called after every turn and returns whether this node's work is over: then the node
  /// leaves, fibers end, and neighbours are told. It also leaves when its supervisor has a verdict.
  /// Requires: called once, before the first turn.
  void begin(std::function<bool()> ended);
  /// `tell` is called for each neighbour that completes a handshake while this node is about to
  /// leave: no other node may be left to tell it that the run is over.
  void tell_newcomers(std::function<void(NodeId)> tell) { tell_newcomer_ = std::move(tell); }
  /// One turn, which never waits. Returns when the next is due, if nothing arrives before.
  Nanoseconds turn();
  /// Whether the node has left.
  bool finished() const { return scheduler_.shutdown().finished(); }

  /// Runs all turns and the waits between them. `ended` is called every few milliseconds even if
  /// nothing arrives. Requires: begin().
  void run();

 private:
  class Source;
  class Handler;

  void leave_if_ended();
  void linger();
  bool may_leave() const;

  const ShellConfig config_;
  const Reroute reroute_;
  const Clock& clock_;
  Transport& transport_;
  std::unique_ptr<Handler> handler_;
  Network network_;
  ActorSystem actors_;
  std::unique_ptr<Source> source_;
  Scheduler scheduler_;
  Supervisor supervisor_;
  std::function<bool()> ended_;
  std::function<void(NodeId)> tell_newcomer_;
  bool leaving_ = false;
  Nanoseconds left_at_ = never;
};

}  // namespace luxodus
