#include "actors/supervise/fetching_cells.hpp"

#include <algorithm>

namespace luxodus {

namespace {

FetchConfig fetch_config(const NodeSetup& node) {
  FetchConfig config = node.fetch;
  config.self = node.net.self;
  return config;
}

CacheConfig cache_config(const SceneObjects& objects, const NodeSetup& node) {
  CacheConfig config;
  config.budget_bytes = node.object_bytes;
  config.largest_build_bytes = peak_build_bytes_of(objects.largest_wire_bytes());
  config.pinned_share = 0;  // nothing is pinned without a profile
  return config;
}

Random jitter_of(NodeId self) {
  Random random(self.value, RandomStream::fetch);
  random.start(0);
  return random;
}

}  // namespace

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

FetchingCells::FetchingCells(const RunSetup& run, const NodeSetup& node, NodeShell& shell)
    : store_(*run.objects, node.net.self),
      builder_(run.scene),
      fetcher_(fetch_config(node), run.objects->places(), store_, shell.network(),
               shell.scheduler().timers(), run.clock, jitter_of(node.net.self)),
      cache_(cache_config(*run.objects, node), run.objects->places().size(), fetcher_, builder_,
             shell.scheduler().fibers(), shell.scheduler().timers(), run.clock),
      source_(cache_, shell.scheduler().fibers()) {
  shell.use(fetcher_);
}

WorkerReport FetchingCells::report() const {
  const ObjectCache::Counters& c = cache_.counters();
  const Fetcher::Counters& f = fetcher_.counters();
  return {c.hits, f.fetches, c.joined, c.builds, c.evictions, 0, f.bytes_in, c.resident_bytes};
}

SchedulerLimits scheduler_limits_of(const NodeSetup& node) {
  SchedulerLimits limits;
  limits.fibers = node.fibers;
  limits.fibers.count = node.photons.fibers + 1;  // and the one that packs flushes
  limits.stall = node.stall;
  // Leases, the watch for the end, and a few to spare.
  limits.timers_beside_fibers = 16 + Fetcher::timers_most(node.fetch) + ObjectCache::timers_most;
  return limits;
}

}  // namespace luxodus
