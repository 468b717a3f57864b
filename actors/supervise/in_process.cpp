#include "actors/supervise/in_process.hpp"

#include <xmmintrin.h>

#include <exception>
#include <mutex>
#include <thread>

#include "actors/objects/scene_objects.hpp"
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

std::optional<std::string> fault_of(const NodesOptions& options, const CompiledScene& scene) {
  if (options.object_bytes == 0) return std::nullopt;
  if (scene.cells.size() < 2)
    return "nodes with a budget need a partition of the geometry: add --cells";
  if (options.replicas < 1 || options.replicas > static_cast<uint32_t>(options.nodes) ||
      options.replicas > limits::holders)
    return "a cell can be held by 1 to " + std::to_string(limits::holders) +
           " nodes, and by no more than there are";
  return std::nullopt;
}

std::vector<ProxyScene::Box> boxes_of(const CompiledScene& scene) {
  std::vector<ProxyScene::Box> boxes;
  for (const GeometryCell& cell : scene.cells) boxes.push_back({cell.low, cell.high});
  return boxes;
}

/// What all nodes of the run have in common.
struct Shared {
  const Graph& graph;
  const LocalRun& run;
  ZmqContext& context;
  const SystemClock& clock;
  uint64_t run_id;
  const ProxyScene* proxies;    // with a budget, else null
  const SceneObjects* objects;  // likewise
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

/// What a worker needs where it does not hold everything: a store for others, a cache for itself.
class FetchingCells {
 public:
  FetchingCells(const Shared& shared, NodeId self, const NodesOptions& options, NodeShell& shell)
      : store_(*shared.objects, self),
        builder_(shared.run.scene()),
        fetcher_(fetch_config(self), shared.objects->places(), store_, shell.network(),
                 shell.scheduler().timers(), shared.clock, jitter_of(self)),
        cache_(cache_config(*shared.objects, options), shared.objects->places().size(), fetcher_,
               builder_, shell.scheduler().fibers(), shell.scheduler().timers(), shared.clock),
        source_(cache_, shell.scheduler().fibers()) {
    shell.use(fetcher_);
  }

  ObjectSource& source() { return source_; }
  void count(NodesReport& report) const {
    report.hits += cache_.counters().hits;
    report.fetches += fetcher_.counters().fetches;
    report.joined += cache_.counters().joined;
    report.builds += cache_.counters().builds;
    report.evictions += cache_.counters().evictions;
    report.fetched_bytes += fetcher_.counters().bytes_in;
    report.largest_resident_bytes = std::max(report.largest_resident_bytes, most_resident_bytes());
  }

 private:
  static FetchConfig fetch_config(NodeId self) {
    FetchConfig config;
    config.self = self;
    return config;
  }
  static CacheConfig cache_config(const SceneObjects& objects, const NodesOptions& options) {
    CacheConfig config;
    config.budget_bytes = options.object_bytes;
    config.largest_build_bytes = built_bytes_of(objects.largest_wire_bytes()) * 8 / 5;
    return config;
  }
  static Random jitter_of(NodeId self) {
    Random random(self.value, RandomStream::fetch);
    random.start(0);
    return random;
  }
  uint64_t most_resident_bytes() const { return cache_.counters().resident_bytes; }

  HeldCells store_;
  CellBuilder builder_;
  Fetcher fetcher_;
  ObjectCache cache_;
  CachedCells source_;
};

class Worker {
 public:
  Worker(const Shared& shared, NodeId self, const NodesOptions& options)
      : transport_(shared.context, {self}, shared.clock),
        shell_({net_config(shared, self), scheduler_limits(options)}, shared.graph, shared.clock,
               transport_),
        cells_(shared.objects == nullptr
                   ? nullptr
                   : std::make_unique<FetchingCells>(shared, self, options, shell_)),
        leases_({{static_cast<uint16_t>(shared.graph.controller())}}, shell_.scheduler(),
                shell_.network()),
        photons_(shared.run.scene(), access(shared), shared.run.seed(), photon_config(options),
                 shell_.scheduler(), leases_) {}

  Result<bool> run(const Shared& shared, NodeId self, NodesReport& report) {
    if (auto joined = join(transport_, shared, self); !joined.ok()) return joined.problem();
    shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
    leases_.start(photons_);
    photons_.start();
    shell_.run_until([this] { return leases_.ended(); });
    if (cells_) cells_->count(report);
    return true;
  }

 private:
  GeometryAccess access(const Shared& shared) const {
    return cells_ ? GeometryAccess::through(*shared.proxies, cells_->source())
                  : GeometryAccess::resident(shared.run.index());
  }
  static SchedulerLimits scheduler_limits(const NodesOptions& options) {
    SchedulerLimits limits;
    limits.fibers.count = options.fibers + 1;  // and the one that packs flushes
    limits.timers_beside_fibers = 16 + Fetcher::timers_most({}) + ObjectCache::timers_most;
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
  std::unique_ptr<FetchingCells> cells_;  // where the node does not hold everything
  LeaseClient leases_;
  PhotonThreads photons_;
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
          NodesReport report;
          auto ok = worker.run(shared, self, report);
          ok.ok() ? count(report) : fail(ok.problem());
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
  /// What all workers counted. Requires: joined.
  const NodesReport& report() const { return report_; }

 private:
  void count(const NodesReport& of_one) {
    const std::lock_guard lock(mutex_);
    report_.hits += of_one.hits;
    report_.fetches += of_one.fetches;
    report_.joined += of_one.joined;
    report_.builds += of_one.builds;
    report_.evictions += of_one.evictions;
    report_.fetched_bytes += of_one.fetched_bytes;
    report_.largest_resident_bytes =
        std::max(report_.largest_resident_bytes, of_one.largest_resident_bytes);
  }
  void fail(const Problem& problem) {
    const std::lock_guard lock(mutex_);
    if (!failed_) problem_ = problem;
    failed_ = true;
  }

  std::mutex mutex_;
  NodesReport report_;
  Problem problem_;
  std::atomic<bool> failed_{false};
  std::vector<std::thread> threads_;
};

}  // namespace

Result<StopReason> run_on_nodes(LocalRun& run, const NodesOptions& options, const StopRule& stop,
                                const std::atomic<bool>& interrupt,
                                const std::function<void(const Progress&)>& report,
                                NodesReport* counted) {
  if (auto fault = fault_of(options, run.scene())) return Problem{{}, *fault};
  auto graph = graph_for(options);
  if (!graph.ok()) return graph.problem();
  const SystemClock clock;
  ZmqContext context({});
  const bool fetching = options.object_bytes > 0;
  const EmbreeDevice device;
  std::optional<SceneObjects> objects;
  std::optional<ProxyScene> proxies;
  if (fetching) {
    objects.emplace(run.scene(), static_cast<uint32_t>(options.nodes), options.replicas);
    proxies.emplace(device, boxes_of(run.scene()));
  }
  const Shared shared{graph.value(),
                      run,
                      context,
                      clock,
                      static_cast<uint64_t>(clock.now()) | 1,
                      fetching ? &*proxies : nullptr,
                      fetching ? &*objects : nullptr};
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
    *counted = workers.report();
    counted->flushes = c.flushes_taken;
    counted->flush_bytes = c.flush_bytes;
    counted->leases = c.leases;
    counted->leases_fenced = c.fenced;
    counted->frames = shell.network().counters().frames_received;
  }
  return controller.reason();
}

}  // namespace luxodus
