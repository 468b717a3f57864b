#include "actors/cast/node/fetching_objects.hpp"

#include <algorithm>

#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/node/residency_setup.hpp"
#include "actors/cast/supervision/supervision.hpp"

namespace luxodus {

namespace {

FetchConfig fetch_config(const RunSetup& run, const NodeSetup& node, NodeTrace* trace) {
  FetchConfig config = node.fetch;
  config.hops = hops_from(run.graph, node.net.self.value);
  config.self = node.net.self;
  config.trace = trace;
  config.buggify = node.buggify;
  config.requests = std::max<size_t>(config.requests, 4 * run.graph.vertices());
  return config;
}

CacheConfig cache_of(const RunSetup& run, const NodeSetup& node, NodeTrace* trace) {
  CacheConfig config = cache_config(*run.objects, node);
  config.trace = trace;
  config.shared = run.shared;
  config.buggify = node.buggify;
  return config;
}

std::optional<FaultyObjects> faulty(ObjectStore& store, const NodeSetup& node, const Clock& clock) {
  if (node.faults.faults.empty()) return std::nullopt;
  return FaultyObjects(store, node.net.self, node.faults, clock);
}

Random jitter_of(NodeId self) {
  Random random(self.value, RandomStream::fetch);
  random.start(0);
  return random;
}

}  // namespace

void WorkerReport::add(const WorkerReport& other) {
  hits += other.hits;
  misses += other.misses;
  fetches += other.fetches;
  joined += other.joined;
  builds += other.builds;
  builds_saved += other.builds_saved;
  evictions += other.evictions;
  waited += other.waited;
  fetched_bytes += other.fetched_bytes;
  largest_resident_bytes = std::max(largest_resident_bytes, other.largest_resident_bytes);
  pinned_bytes += other.pinned_bytes;
  tally_full += other.tally_full;
  max_tally_bytes = std::max(max_tally_bytes, other.max_tally_bytes);
  fetch_delay.merge(other.fetch_delay);
  object_wait.merge(other.object_wait);
  hops += other.hops;
  processor_ns += other.processor_ns;
  longest_turn = std::max(longest_turn, other.longest_turn);
  if (failed == ActorName::none) failed = other.failed;
}

FetchingObjects::FetchingObjects(const RunSetup& run, const NodeSetup& node, NodeShell& shell,
                                 const BuilderMaker& make_builder, NodeTrace* trace)
    : self_(node.net.self),
      store_(*run.objects, node.net.self),
      faulty_(faulty(store_, node, shell.scheduler().clock())),
      builder_(make_builder(run.scene, run.objects->parts())),
      server_(fetch_config(run, node, trace), cache_of(run, node, trace), run.objects->places(),
              faulty_ ? static_cast<ObjectStore&>(*faulty_) : store_, *builder_, shell.scheduler(),
              shell.actors(), jitter_of(node.net.self)),
      source_(run.objects->parts(), server_.cache(), shell.scheduler().fibers(), node.prefetch,
              trace) {
  add_to(shell, role::part_server, server_);
}

void FetchingObjects::add_metrics(Metrics& metrics) const {
  server_.add_metrics(metrics);
}

WorkerReport FetchingObjects::report() const {
  const ObjectCache& cache = server_.cache();
  const ObjectCache::Counters& c = cache.counters();
  const Fetcher& fetcher = server_.fetcher();
  const Fetcher::Counters& f = fetcher.counters();
  WorkerReport report;
  report.node = self_;
  report.hits = c.hits;
  report.misses = c.misses;
  report.fetches = f.fetches;
  report.joined = c.joined;
  report.builds = c.builds;
  report.builds_saved = c.builds_saved;
  report.evictions = c.evictions;
  report.fetched_bytes = f.bytes_in;
  report.largest_resident_bytes = c.resident_bytes;
  report.pinned_bytes = c.pinned_bytes;
  report.object_wait = cache.wait_time();
  for (uint8_t hops = 1; hops <= limits::hops; ++hops) {
    report.fetch_delay.merge(fetcher.delay(hops));
    report.hops += hops * fetcher.delay(hops).count();
  }
  return report;
}

}  // namespace luxodus
