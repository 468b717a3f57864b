// What a node of a run is made from, whoever decides it: options of one process, or the file of a
// cluster. Plain values and references; immutable while the nodes run.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "actors/cast/coordinator/run_coordinator.hpp"
#include "actors/cast/coordinator/sub_coordinator.hpp"
#include "actors/cast/display/display_actor.hpp"
#include "actors/cast/node/node_shell.hpp"
#include "actors/cast/node/observation.hpp"
#include "actors/cast/parts/scene_objects.hpp"
#include "actors/cast/tracing/tracing_fibers.hpp"
#include "actors/cast/tracing/tracing_worker.hpp"
#include "actors/results/run/scene_state.hpp"
#include "runtime/config/cluster_config.hpp"
#include "runtime/net/faulty_transport.hpp"
#include "runtime/net/zmq_transport.hpp"
#include "topology/coordination_tree.hpp"

namespace luxodus {

/// What all nodes of one process have in common. All that is referred to outlives the nodes.
struct RunSetup {
  const CompiledScene& scene;
  const SceneIndex* index = nullptr;      // where everything is resident
  const ProxyScene* proxies = nullptr;    // where objects are fetched
  const SceneObjects* objects = nullptr;  // likewise
  uint64_t seed = 0;
  const Graph& graph;
  std::vector<std::string> names;      // of nodes, by number
  Observation* observation = nullptr;  // where somebody watches
  ShardPlan shards = {};               // of the totals
  SharedObjects* shared = nullptr;  // what nodes of the process have built; null: to each its own
  const Routes* routes = nullptr;   // of the whole graph, where they were made once for all
  std::optional<NodeId> display = {};  // where the run is shown; nothing: nowhere
  /// Over the graph: who coordinates whom. Null: the controller all, where it is another process.
  const CoordinationTree* tree = nullptr;
  /// Makes states of the scene for workers that trace whatever is entered; null: they trace a run.
  StateMaker* states = nullptr;

  /// Whether a worker coordinates others.
  bool coordinates(NodeId worker) const {
    return tree != nullptr && tree->coordinates(worker.value);
  }

  /// Of a node, for people.
  std::string name_of(NodeId node) const {
    return node.value < names.size() ? names[node.value] : "node " + std::to_string(node.value);
  }
};

/// What is a node's own.
struct NodeSetup {
  NetConfig net;
  NodeLinks links;
  std::optional<KeyPair> keys;
  std::map<NodeId, std::string> public_keys;  // of neighbours, where there are keys
  bool insecure = false;
  NodeId controller;
  PhotonConfig photons;
  FiberLimits fibers;  // stacks and guards; how many follows from `photons`
  Nanoseconds stall = SchedulerLimits{}.stall;
  Nanoseconds start = CoordinatorConfig{}.start;
  Nanoseconds lost = CoordinatorConfig{}.lost;
  Nanoseconds rejoin = TracingWorkerConfig{}.rejoin;
  Nanoseconds lease_time = CoordinatorConfig{}.lease_time;
  FetchConfig fetch;
  size_t object_bytes = 0;  // for built objects, where objects are fetched
  double pinned_share = 0;  // of these for pinned ones, at most
  std::vector<uint32_t> pins;
  size_t prefetch = 0;  // cells asked for ahead of the one that is waited for
  /// The controller's: see CoordinatorConfig::group_ranks.
  std::vector<std::vector<uint32_t>> group_ranks;
  uint64_t tally_bytes = UINT64_MAX;  // for scores, totals and a flush
  Nanoseconds shutdown_phase = ShellConfig{}.shutdown_phase;
  /// What shall go wrong, on purpose. Requires: the same at all nodes.
  FaultPlan faults;
  bool one_clock = true;         // all nodes are on one host
  RunOutput* display = nullptr;  // of the node where the run is shown; else null
  /// Rare ways, in simulations: the same in `net`. Null: none.
  Buggify* buggify = nullptr;
};

/// Makes what builds a node's objects. What it is given outlives what it makes.
using BuilderMaker = std::function<std::unique_ptr<ObjectBuilder>(const CompiledScene& scene,
                                                                  const SceneParts& parts)>;
/// The one that builds them of their bytes.
std::unique_ptr<ObjectBuilder> make_part_builder(const CompiledScene& scene,
                                                 const SceneParts& parts);

/// Makes what an actor's blocking calls are made by.
using CallsMaker = std::function<std::unique_ptr<BlockingCalls>(Scheduler&)>;
inline std::unique_ptr<BlockingCalls> calls_on_a_thread(Scheduler& scheduler) {
  return std::make_unique<BlockingThread>(scheduler.handoff());
}

/// What stands between a node and its machine: a simulation puts its own here, and nothing else.
struct NodeSeams {
  const Clock& clock;
  Transport& transport;
  /// Of photon-threads.
  TracerMaker make_tracer = make_batch_tracer;
  BuilderMaker make_builder = make_part_builder;
  /// Of calls that may block.
  CallsMaker make_calls = calls_on_a_thread;
};

/// What the real nodes of one process share of their machine.
struct Machine {
  const Clock& clock;
  ZmqContext& context;
};

/// A node's way to its neighbours: its sockets, behind the faults that the setup asks for.
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
  /// What went wrong between this node and others while they met, to add to a sentence; "" if
  /// nothing did: who was turned away, by whom this node was, which links are refused and why.
  std::string meeting_trouble(const Network& network) const;

 private:
  Machine machine_;
  ZmqTransport sockets_;
  std::optional<FaultyTransport> faulty_;
};

/// What a coordinator of the run has in common with the others: whom it leads, by what times.
CoordinatorConfig coordinator_config(const RunSetup& run, const NodeSetup& node);

/// Listens and connects as the setup says.
/// Errors: an endpoint that is taken, is none, or asks for keys that there are not.
Result<void> join_links(ZmqTransport& transport, const NodeSetup& node);

/// The identity that all nodes of a run share, and limits that follow from its graph.
void complete(NetConfig& net, const RunSetup& run);

}  // namespace luxodus
