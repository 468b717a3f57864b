#include "actors/supervise/worker.hpp"

#include <algorithm>

#include "actors/supervise/node_plan.hpp"

namespace luxodus {

void WorkerReport::add(const WorkerReport& other) {
  hits += other.hits;
  fetches += other.fetches;
  joined += other.joined;
  builds += other.builds;
  evictions += other.evictions;
  fetched_bytes += other.fetched_bytes;
  largest_resident_bytes = std::max(largest_resident_bytes, other.largest_resident_bytes);
}

/// What a worker needs where it does not hold everything: a store for others, a cache for itself.
class Worker::FetchingCells {
 public:
  FetchingCells(const RunSetup& run, const NodeSetup& node, NodeShell& shell, NodeTrace* trace)
      : store_(*run.objects, node.net.self),
        builder_(run.scene),
        fetcher_(fetch_config(node, trace), run.objects->places(), store_, shell.network(),
                 shell.scheduler().timers(), run.clock, jitter_of(node.net.self)),
        cache_(cache_config(*run.objects, node, trace), run.objects->places().size(), fetcher_,
               builder_, shell.scheduler().fibers(), shell.scheduler().timers(), run.clock),
        source_(cache_, shell.scheduler().fibers(), trace) {
    shell.use(fetcher_);
  }

  ObjectSource& source() { return source_; }
  void add_metrics(Metrics& metrics) const {
    fetcher_.add_metrics(metrics);
    cache_.add_metrics(metrics);
  }
  WorkerReport report() const {
    const ObjectCache::Counters& c = cache_.counters();
    const Fetcher::Counters& f = fetcher_.counters();
    return {c.hits, f.fetches, c.joined, c.builds, c.evictions, f.bytes_in, c.resident_bytes};
  }

 private:
  static FetchConfig fetch_config(const NodeSetup& node, NodeTrace* trace) {
    FetchConfig config = node.fetch;
    config.trace = trace;
    config.self = node.net.self;
    return config;
  }
  static Random jitter_of(NodeId self) {
    Random random(self.value, RandomStream::fetch);
    random.start(0);
    return random;
  }

  HeldCells store_;
  CellBuilder builder_;
  Fetcher fetcher_;
  ObjectCache cache_;
  CachedCells source_;
};

namespace {

LeaseClientConfig lease_config(const NodeSetup& node, NodeTrace* trace) {
  LeaseClientConfig config;
  config.controller = node.controller;
  config.trace = trace;
  return config;
}

PhotonConfig photon_config(const NodeSetup& node, NodeTrace* trace) {
  PhotonConfig config = node.photons;
  config.trace = trace;
  return config;
}

}  // namespace

Worker::Worker(const RunSetup& run, const NodeSetup& node)
    : run_(run),
      node_(node),
      trace_(run.observation == nullptr ? nullptr : run.observation->trace_of(node.net.self)),
      transport_(run.context, {node.net.self, node.keys, node.insecure}, run.clock),
      shell_({node.net, worker_limits(node), ShellConfig{}.room_bytes_most, node.shutdown_phase},
             run.graph, run.clock, transport_),
      cells_(run.objects == nullptr ? nullptr
                                    : std::make_unique<FetchingCells>(run, node, shell_, trace_)),
      leases_(lease_config(node, trace_), shell_.scheduler(), shell_.network()),
      photons_(run.scene,
               cells_ ? GeometryAccess::through(*run.proxies, cells_->source())
                      : GeometryAccess::resident(*run.index),
               run.seed, photon_config(node, trace_), shell_.scheduler(), leases_) {}

Worker::~Worker() = default;

void Worker::show_to(Observation& seen) {
  metrics_.emplace(run_.names, node_.net.self, "worker", shell_.scheduler(), shell_.network());
  leases_.add_metrics(metrics_->registry());
  photons_.add_metrics(metrics_->registry());
  if (cells_) cells_->add_metrics(metrics_->registry());
  metrics_->add_rate({"particles_per_second", "", "Particles traced in a second.", ""},
                     photons_.counters().particles);
  metrics_->start(seen);
}

Result<WorkerReport> Worker::run(const std::function<bool()>& stop) {
  if (auto joined = join_links(transport_, node_); !joined.ok()) return joined.problem();
  shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
  leases_.start(photons_);
  photons_.start();
  if (run_.observation != nullptr) show_to(*run_.observation);
  shell_.scheduler().seal();
  shell_.run_until([&] { return leases_.ended() || stop(); });
  return cells_ ? cells_->report() : WorkerReport{};
}

}  // namespace luxodus
