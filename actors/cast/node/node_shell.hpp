// A node put together: clock, network, scheduler, the system of its actors, and their supervisor.
// Which actors those are makes it a worker or the controller. It keeps the routes. One OS thread
// runs it, or a simulation gives it its turns. Thread rule: made and run on one thread; wake() from
// any.
#pragma once

#include <functional>
#include <vector>

#include "actors/cast/supervision/supervisor.hpp"
#include "runtime/actor/scheduler.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "topology/node_routes.hpp"

namespace luxodus {

/// All links of a graph.
std::vector<Edge> edges_of(const Graph& graph);

struct ShellConfig {
  NetConfig net;
  SchedulerLimits scheduler;
  size_t max_payload_bytes = 1 << 30;       // behind messages that wait in mailboxes
  Nanoseconds shutdown_phase = seconds(5);  // for each step of its end
  /// Of the whole graph, where somebody has made them for all nodes of the process.
  const Routes* routes = nullptr;
};

class NodeShell {
 public:
  /// Requires: graph and transport outlive this.
  NodeShell(const ShellConfig& config, const Graph& graph, const Clock& clock,
            Transport& transport);
  ~NodeShell();

  Scheduler& scheduler() { return scheduler_; }
  const Scheduler& scheduler() const { return scheduler_; }
  Network& network() { return network_; }
  ActorSystem& actors() { return actors_; }
  Supervisor& supervisor() { return supervisor_; }
  const Supervisor& supervisor() const { return supervisor_; }

  /// An actor of this node, which others reach by its name and its supervisor watches.
  /// Requires: it outlives the run.
  template <class NodeActorType>
  void add(ActorName name, NodeActorType& actor) {
    actors_.add(name, actor);
    supervisor_.watch(name, actor);
  }

  /// Says when this node's work is over: then it leaves, fibers end, neighbours are told. `ended`
  /// is asked after every turn. It leaves as well when its supervisor has a verdict.
  /// Requires: once, before the first turn.
  void begin(std::function<bool()> ended);
  /// Has `tell` called for each neighbour that is met while this node is about to leave: nobody
  /// else may be left who could tell it that the run is over.
  void tell_newcomers(std::function<void(NodeId)> tell) { tell_newcomer_ = std::move(tell); }
  /// One turn, which never waits. Returns when the next is due, if nothing arrives before.
  Nanoseconds turn();
  /// Whether the node has left.
  bool finished() const { return scheduler_.shutdown().finished(); }

  /// All turns and the waits between them. What `ended` asks may change while nothing arrives: it
  /// is looked at every few milliseconds. Requires: begin().
  void run();

 private:
  class Source;
  class Handler;

  void leave_if_ended();
  void linger();
  bool may_leave() const;

  const ShellConfig config_;
  const Graph& graph_;
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
