// Configuration of a run's nodes, made from the options of one process or from a cluster file.
// Plain values and references, immutable while the nodes run; any thread.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "actors/cast/coordinator/run_coordinator.hpp"
#include "actors/cast/coordinator/sub_coordinator.hpp"
#include "actors/cast/display/display_actor.hpp"
#include "actors/cast/node/observation.hpp"
#include "actors/cast/parts/scene_objects.hpp"
#include "actors/cast/tracing/tracing_fibers.hpp"
#include "actors/cast/tracing/tracing_worker.hpp"
#include "actors/results/run/scene_state.hpp"
#include "runtime/config/cluster_config.hpp"
#include "runtime/net/faulty_transport.hpp"
#include "runtime/net/zmq_transport.hpp"
#include "runtime/node/node_shell.hpp"
#include "topology/coordination_tree.hpp"
#include "topology/routes.hpp"

namespace luxodus {

/// What all nodes of one process have in common. All references outlive the nodes.
struct RunSetup {
  const CompiledScene& scene;
  const SceneIndex* index = nullptr;      // if everything is resident
  const ProxyScene* proxies = nullptr;    // if objects are fetched
  const SceneObjects* objects = nullptr;  // if objects are fetched
  uint64_t seed = 0;
  const Graph& graph;
  std::vector<std::string> names;      // of nodes, by number
  Observation* observation = nullptr;  // null: no metrics and traces
  ShardPlan shards = {};               // of the totals
  SharedObjects* shared = nullptr;     // objects built by nodes of the process; null: no sharing
  const Routes* routes = nullptr;      // of the whole graph, if computed once for all nodes
  std::optional<NodeId> display = {};  // node that shows the run; nothing: none
  /// The tree of coordinators over the graph. Null: the controller leads all, in another process.
  const CoordinationTree* tree = nullptr;
  /// Builds states of the scene, for workers that trace whichever is entered; null: they trace a
  /// run.
  StateMaker* states = nullptr;

  /// Whether a worker coordinates others.
  bool coordinates(NodeId worker) const {
    return tree != nullptr && tree->coordinates(worker.value);
  }

  /// A node's name for messages.
  std::string name_of(NodeId node) const {
    return node.value < names.size() ? names[node.value] : "node " + std::to_string(node.value);
  }
};

/// What is specific to a node.
struct NodeSetup {
  NetConfig net;
  NodeLinks links;
  std::optional<KeyPair> keys;
  std::map<NodeId, std::string> public_keys;  // of neighbours, if there are keys
  bool insecure = false;
  NodeId controller;
  PhotonConfig photons;
  FiberLimits fibers;  // stacks and guards; their number follows from `photons`
  Nanoseconds stall = SchedulerLimits{}.stall;
  Nanoseconds start = CoordinatorConfig{}.start;
  Nanoseconds lost = CoordinatorConfig{}.lost;
  Nanoseconds rejoin = TracingWorkerConfig{}.rejoin;
  Nanoseconds lease_time = CoordinatorConfig{}.lease_time;
  FetchConfig fetch;
  size_t object_bytes = 0;  // for built objects, if objects are fetched
  double pinned_share = 0;  // share of these for pinned ones, at most
  std::vector<uint32_t> pins;
  size_t prefetch = 0;  // cells prefetched for a fiber that waits for one
  /// For the controller: see CoordinatorConfig::group_ranks.
  std::vector<std::vector<uint32_t>> group_ranks;
  uint64_t tally_bytes = UINT64_MAX;  // for scores, totals and a flush
  Nanoseconds shutdown_phase = ShellConfig{}.shutdown_phase;
  /// Injected faults. Requires: equal at all nodes.
  FaultPlan faults;
  bool one_clock = true;         // all nodes are on one host
  RunOutput* display = nullptr;  // for the node that shows the run; otherwise null
  /// Rare paths, in simulations; the same as in `net`. Null: none.
  Buggify* buggify = nullptr;
};

/// Makes the builder of a node's objects. The arguments outlive it.
using BuilderMaker = std::function<std::unique_ptr<ObjectBuilder>(const CompiledScene& scene,
                                                                  const SceneParts& parts)>;
/// Builds objects from their bytes.
std::unique_ptr<ObjectBuilder> make_part_builder(const CompiledScene& scene,
                                                 const SceneParts& parts);

/// Makes the BlockingCalls of an actor.
using CallsMaker = std::function<std::unique_ptr<BlockingCalls>(Scheduler&)>;
inline std::unique_ptr<BlockingCalls> calls_on_a_thread(Scheduler& scheduler) {
  return std::make_unique<BlockingThread>(scheduler.handoff());
}

/// A node's access to its machine; a simulation replaces these, and nothing else.
struct NodeSeams {
  const Clock& clock;
  Transport& transport;
  /// For photon-threads.
  TracerMaker make_tracer = make_batch_tracer;
  BuilderMaker make_builder = make_part_builder;
  /// For calls that may block.
  CallsMaker make_calls = calls_on_a_thread;
};

/// What the real nodes of one process share.
struct Machine {
  const Clock& clock;
  ZmqContext& context;
};

/// A node's sockets, with the faults of the setup.
class NodeTransport {
 public:
  NodeTransport(const Machine& machine, const NodeSetup& node)
      : machine_(machine),
        sockets_(machine.context, {node.net.self, node.keys, node.insecure}, machine.clock) {
    if (node.faults.any())
      faulty_.emplace(
          sockets_,
          FaultyConfig{node.net.self, node.faults, node.one_clock, limits::held_back_bytes, {}, {}},
          machine.clock);
  }

  ZmqTransport& sockets() { return sockets_; }
  Transport& transport() { return faulty_ ? static_cast<Transport&>(*faulty_) : sockets_; }
  NodeSeams seams() { return {machine_.clock, transport()}; }
  /// What went wrong between this node and others during the handshake, to append to a sentence; ""
  /// if nothing did: rejected connections, refusals of this node, refused links and their reasons.
  std::string meeting_trouble(const Network& network) const;

 private:
  Machine machine_;
  ZmqTransport sockets_;
  std::optional<FaultyTransport> faulty_;
};

/// Configuration common to all coordinators of a run: workers and timeouts.
CoordinatorConfig coordinator_config(const RunSetup& run, const NodeSetup& node);

/// Listens and connects as the setup says. Errors: an endpoint that is in use, invalid, or needs
/// keys that are missing.
Result<void> join_links(ZmqTransport& transport, const NodeSetup& node);

/// Sets the identity that all nodes of a run share, and limits that follow from its graph.
void complete(NetConfig& net, const RunSetup& run);

}  // namespace luxodus
