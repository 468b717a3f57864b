#include "actors/supervise/worker.hpp"

#include <algorithm>

#include "actors/supervise/residency_setup.hpp"

namespace luxodus {

void WorkerReport::add(const WorkerReport& other) {
  hits += other.hits;
  misses += other.misses;
  fetches += other.fetches;
  joined += other.joined;
  builds += other.builds;
  evictions += other.evictions;
  fetched_bytes += other.fetched_bytes;
  largest_resident_bytes = std::max(largest_resident_bytes, other.largest_resident_bytes);
  pinned_bytes += other.pinned_bytes;
}

/// What a worker needs where it does not hold everything: a store for others, a cache for itself.
class Worker::FetchingCells {
 public:
  FetchingCells(const RunSetup& run, const NodeSetup& node, NodeShell& shell)
      : self_(node.net.self),
        store_(*run.objects, node.net.self),
        builder_(run.scene),
        fetcher_(fetch_config(run, node), run.objects->places(), store_, shell.network(),
                 shell.scheduler().timers(), run.clock, jitter_of(node.net.self)),
        cache_(cell_cache(*run.objects, node.object_bytes, node.pinned_share),
               run.objects->places().size(), fetcher_, builder_, shell.scheduler().fibers(),
               shell.scheduler().timers(), run.clock),
        source_(cache_, shell.scheduler().fibers()) {
    shell.use(fetcher_);
  }

  ObjectSource& source() { return source_; }
  void pin(std::span<const uint32_t> cells) { cache_.pin(cells); }
  WorkerReport report() const {
    const ObjectCache::Counters& c = cache_.counters();
    const Fetcher::Counters& f = fetcher_.counters();
    return {self_,    c.hits,      c.misses,   f.fetches,        c.joined,
            c.builds, c.evictions, f.bytes_in, c.resident_bytes, c.pinned_bytes};
  }

 private:
  static FetchConfig fetch_config(const RunSetup& run, const NodeSetup& node) {
    FetchConfig config = node.fetch;
    config.self = node.net.self;
    config.hops = hops_from(run.graph, node.net.self.value);
    return config;
  }
  static Random jitter_of(NodeId self) {
    Random random(self.value, RandomStream::fetch);
    random.start(0);
    return random;
  }

  const NodeId self_;
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
      transport_(run.context, {node.net.self, node.keys, node.insecure}, run.clock),
      shell_({node.net, scheduler_limits(node)}, run.graph, run.clock, transport_),
      cells_(run.objects == nullptr ? nullptr : std::make_unique<FetchingCells>(run, node, shell_)),
      leases_({node.controller}, shell_.scheduler(), shell_.network()),
      photons_(run.scene,
               cells_ ? GeometryAccess::through(*run.proxies, cells_->source())
                      : GeometryAccess::resident(*run.index),
               run.seed, node.photons, shell_.scheduler(), leases_) {}

Worker::~Worker() = default;

Result<WorkerReport> Worker::run(const std::function<bool()>& stop) {
  if (auto joined = join_links(transport_, node_); !joined.ok()) return joined.problem();
  shell_.add([this](const Delivery& d) { return leases_.deliver(d); });
  leases_.start(photons_);
  if (cells_) cells_->pin(node_.pins);
  photons_.start();
  shell_.run_until([&] { return leases_.ended() || stop(); });
  return cells_ ? cells_->report() : WorkerReport{};
}

}  // namespace luxodus
