#include "actors/supervise/in_process.hpp"

#include <xmmintrin.h>

#include <exception>
#include <mutex>
#include <thread>

#include "actors/photon/lease_client.hpp"
#include "actors/source/controller.hpp"
#include "actors/supervise/node_shell.hpp"
#include "runtime/net/zmq_transport.hpp"
#include "topology/amp.hpp"
#include "topology/shipped.hpp"

namespace luxodus {

namespace {

constexpr uint32_t controller_links_most = 4;

/// A shipped graph where there is one, else one that is searched for.
Result<Graph> graph_for(const NodesOptions& options) {
  const auto nodes = static_cast<uint32_t>(options.nodes);
  const auto links = static_cast<uint32_t>(options.links);
  const uint32_t controller_links = std::min(nodes, controller_links_most);
  if (auto shipped = shipped_graph({nodes, links, controller_links})) return *shipped;
  AmpRequest request;
  request.nodes = nodes;
  request.links = links;
  request.controller_links = controller_links;
  auto found = find_amp(request, [] { return false; });
  if (!found.ok()) return found.problem();
  return std::move(found).value().graph;
}

/// What all nodes of the run have in common.
struct Shared {
  const Graph& graph;
  const LocalRun& run;
  ZmqContext& context;
  const SystemClock& clock;
  uint64_t run_id;
};

NetConfig net_config(const Shared& shared, NodeId self) {
  NetConfig net;
  net.self = self;
  net.incarnation = {shared.run_id + self.value + 1};
  net.identity.node = self;
  net.identity.scene_hash = shared.run.scene().scene_hash;
  net.identity.topology_hash = shared.graph.hash();
  net.identity.run_id = shared.run_id;
  net.nodes = shared.graph.vertices();
  net.edges = edges_of(shared.graph);
  net.hop_limit = static_cast<uint8_t>(
      std::min<uint32_t>(limits::hops, balanced_routes(shared.graph).longest() + 2));
  net.message_bytes_most = 1u << 30;  // a flush of ten million bins has a third of it
  return net;
}

Endpoints endpoints_of(NodeId node) {
  const std::string name = "inproc://node-" + std::to_string(node.value);
  return {name, name + "-bulk"};
}

/// Listens, and connects to the neighbours with smaller numbers.
Result<bool> join(ZmqTransport& transport, const Shared& shared, NodeId self) {
  if (auto at = transport.listen(endpoints_of(self)); !at.ok()) return at.problem();
  for (const Vertex neighbour : shared.graph.all().of(self.value)) {
    if (neighbour > self.value) continue;
    const NodeId node{static_cast<uint16_t>(neighbour)};
    if (auto to = transport.connect(node, endpoints_of(node)); !to.ok()) return to.problem();
  }
  return true;
}

class Worker {
 public:
  Worker(const Shared& shared, NodeId self, const NodesOptions& options)
      : transport_(shared.context, {self}, shared.clock),
        shell_({net_config(shared, self), scheduler_limits(options)}, shared.graph, shared.clock,
               transport_),
        leases_({{static_cast<uint16_t>(shared.graph.controller())}}, shell_.scheduler(),
                shell_.network()),
        photons_(shared.run.scene(), GeometryAccess::resident(shared.run.index()),
                 shared.run.seed(), photon_config(options), shell_.scheduler(), leases_) {}

  Result<bool> run(const Shared& shared, NodeId self) {
    if (auto joined = join(transport_, shared, self); !joined.ok()) return joined.problem();
    shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
    leases_.start(photons_);
    photons_.start();
    shell_.run_until([this] { return leases_.ended(); });
    return true;
  }
  uint64_t frames() const { return shell_frames_; }

 private:
  static SchedulerLimits scheduler_limits(const NodesOptions& options) {
    SchedulerLimits limits;
    limits.fibers.count = options.fibers + 1;  // and the one that packs flushes
    return limits;
  }
  static PhotonConfig photon_config(const NodesOptions& options) {
    PhotonConfig config;
    config.fibers = options.fibers;
    config.portion = static_cast<int64_t>(options.portion);
    return config;
  }

  ZmqTransport transport_;
  NodeShell shell_;
  LeaseClient leases_;
  PhotonThreads photons_;
  uint64_t shell_frames_ = 0;
};

/// Threads that run workers; the first problem of any of them.
class WorkerThreads {
 public:
  WorkerThreads(const Shared& shared, const NodesOptions& options) {
    for (int i = 0; i < options.nodes; ++i) {
      threads_.emplace_back([this, &shared, &options, self = NodeId{static_cast<uint16_t>(i)}] {
        _mm_setcsr(_mm_getcsr() | 0x8040);  // denormals to zero, as in the plain loop
        try {
          Worker worker(shared, self, options);
          if (auto ok = worker.run(shared, self); !ok.ok()) fail(ok.problem());
        } catch (const std::exception& e) {
          fail({{}, "node " + std::to_string(self.value) + ": " + e.what()});
        }
      });
    }
  }
  ~WorkerThreads() { join(); }
  void join() {
    for (std::thread& thread : threads_)
      if (thread.joinable()) thread.join();
  }
  bool failed() const { return failed_; }
  const Problem& problem() const { return problem_; }

 private:
  void fail(const Problem& problem) {
    const std::lock_guard lock(mutex_);
    if (!failed_) problem_ = problem;
    failed_ = true;
  }

  std::mutex mutex_;
  Problem problem_;
  std::atomic<bool> failed_{false};
  std::vector<std::thread> threads_;
};

}  // namespace

Result<StopReason> run_on_nodes(LocalRun& run, const NodesOptions& options, const StopRule& stop,
                                const std::atomic<bool>& interrupt,
                                const std::function<void(const Progress&)>& report,
                                NodesReport* counted) {
  auto graph = graph_for(options);
  if (!graph.ok()) return graph.problem();
  const SystemClock clock;
  ZmqContext context({});
  const Shared shared{graph.value(), run, context, clock, static_cast<uint64_t>(clock.now()) | 1};
  const NodeId self{static_cast<uint16_t>(graph.value().controller())};
  ZmqTransport transport(context, {self}, clock);
  NodeShell shell({net_config(shared, self), {}}, graph.value(), clock, transport);
  ControllerConfig config;
  for (uint16_t i = 0; i < options.nodes; ++i) config.workers.push_back({i});
  Controller controller(config, run, stop, interrupt, report, shell.scheduler(), shell.network());
  shell.add([&](const Delivery& d) { return controller.deliver(d); });
  if (auto joined = join(transport, shared, self); !joined.ok()) return joined.problem();
  const Nanoseconds began = clock.now();
  WorkerThreads workers(shared, options);
  controller.start();
  shell.run_until([&] { return controller.ended() || workers.failed(); });
  run.add_seconds(static_cast<double>(clock.now() - began) * 1e-9);
  workers.join();
  if (workers.failed()) return workers.problem();
  if (counted != nullptr) {
    const Controller::Counters& c = controller.counters();
    *counted = {c.flushes_taken, c.flush_bytes, c.leases, c.fenced,
                shell.network().counters().frames_received};
  }
  return controller.reason();
}

}  // namespace luxodus
