#include "actors/supervise/worker.hpp"

#include <algorithm>

namespace luxodus {

void WorkerReport::add(const WorkerReport& other) {
  hits += other.hits;
  fetches += other.fetches;
  joined += other.joined;
  builds += other.builds;
  evictions += other.evictions;
  waited += other.waited;
  fetched_bytes += other.fetched_bytes;
  largest_resident_bytes = std::max(largest_resident_bytes, other.largest_resident_bytes);
}

/// What a worker needs where it does not hold everything: a store for others, a cache for itself.
class Worker::FetchingCells {
 public:
  FetchingCells(const RunSetup& run, const NodeSetup& node, NodeShell& shell)
      : store_(*run.objects, node.net.self),
        builder_(run.scene),
        fetcher_(fetch_config(node), run.objects->places(), store_, shell.network(),
                 shell.scheduler().timers(), run.clock, jitter_of(node.net.self)),
        cache_(cache_config(*run.objects, node), run.objects->places().size(), fetcher_, builder_,
               shell.scheduler().fibers(), shell.scheduler().timers(), run.clock),
        source_(cache_, shell.scheduler().fibers()) {
    shell.use(fetcher_);
  }

  ObjectSource& source() { return source_; }
  WorkerReport report() const {
    const ObjectCache::Counters& c = cache_.counters();
    const Fetcher::Counters& f = fetcher_.counters();
    return {c.hits, f.fetches, c.joined, c.builds, c.evictions, f.bytes_in, 0, c.resident_bytes};
  }

 private:
  static FetchConfig fetch_config(const NodeSetup& node) {
    FetchConfig config = node.fetch;
    config.self = node.net.self;
    return config;
  }
  static CacheConfig cache_config(const SceneObjects& objects, const NodeSetup& node) {
    CacheConfig config;
    config.budget_bytes = node.object_bytes;
    config.largest_build_bytes = peak_build_bytes_of(objects.largest_wire_bytes());
    config.pinned_share = 0;  // nothing is pinned without a profile
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

SchedulerLimits scheduler_limits(const NodeSetup& node) {
  SchedulerLimits limits;
  limits.fibers = node.fibers;
  limits.fibers.count = node.photons.fibers + 1;  // and the one that packs flushes
  limits.stall = node.stall;
  // Leases, the watch for the end, and a few to spare.
  limits.timers_beside_fibers = 16 + Fetcher::timers_most(node.fetch) + ObjectCache::timers_most;
  return limits;
}

}  // namespace

Worker::Worker(const RunSetup& run, const NodeSetup& node)
    : node_(node),
      transport_(run, node),
      shell_({node.net, scheduler_limits(node)}, run.graph, run.clock, transport_.transport()),
      cells_(run.objects == nullptr ? nullptr : std::make_unique<FetchingCells>(run, node, shell_)),
      leases_({node.controller}, shell_.scheduler(), shell_.network()),
      photons_(run.scene,
               cells_ ? GeometryAccess::through(*run.proxies, cells_->source())
                      : GeometryAccess::resident(*run.index),
               run.seed, node.photons, shell_.scheduler(), leases_) {}

Worker::~Worker() = default;

Result<WorkerReport> Worker::run(const std::function<bool()>& stop) {
  if (auto joined = join_links(transport_.sockets(), node_); !joined.ok()) return joined.problem();
  shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
  leases_.start(photons_);
  photons_.start();
  shell_.run_until([&] { return leases_.ended() || stop(); });
  WorkerReport report = cells_ ? cells_->report() : WorkerReport{};
  report.waited = shell_.scheduler().counters().waited;
  return report;
}

}  // namespace luxodus
