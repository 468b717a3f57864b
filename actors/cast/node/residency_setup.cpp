#include "actors/cast/node/residency_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <limits>

#include "actors/results/run/batch_plan.hpp"

namespace luxodus {

CacheConfig object_cache(const SceneObjects& objects, size_t object_bytes, double pinned_share) {
  CacheConfig config;
  config.budget_bytes = object_bytes;
  config.largest_build_bytes = objects.largest_build_bytes();
  const size_t kept = 2 * config.largest_build_bytes;  // for one object and one build
  const double room = object_bytes > kept ? static_cast<double>(object_bytes - kept) /
                                                static_cast<double>(object_bytes)
                                          : 0;
  config.pinned_share = std::min(pinned_share, room);
  return config;
}

std::vector<uint32_t> hops_from(const Graph& graph, Vertex from) {
  std::vector<uint32_t> hops(graph.vertices(), std::numeric_limits<uint32_t>::max());
  std::deque<Vertex> next{from};
  hops[from] = 0;
  while (!next.empty()) {
    const Vertex at = next.front();
    next.pop_front();
    if (at != from && !graph.forwards(at)) continue;
    for (const Vertex neighbour : graph.all().of(at)) {
      if (hops[neighbour] != std::numeric_limits<uint32_t>::max()) continue;
      hops[neighbour] = hops[at] + 1;
      next.push_back(neighbour);
    }
  }
  return hops;
}

Residency residency_for(const ReferenceProfile& profile, const CompiledScene& scene,
                        const SceneObjects& objects, const Graph& graph,
                        const ResidencyBudgets& budgets) {
  ResidencyRequest request{
      profile, BatchPlan(scene).shares(), scene.batch_particles, {}, {}, {}, {},
      {},      budgets.replicas};
  for (uint32_t object = 0; object < objects.places().size(); ++object) {
    const uint64_t built = profile.built_bytes[object];
    request.wire_bytes.push_back(objects.places()[object].wire_bytes);
    request.built_bytes.push_back(built > 0 ? built : objects.built_bytes(object));
  }
  for (Vertex node = 0; node < graph.workers(); ++node) {
    const CacheConfig cache =
        object_cache(objects, budgets.object_bytes[node], budgets.pinned_share);
    request.resident_bytes.push_back(cache.max_resident_bytes());
    request.pinned_bytes.push_back(cache.max_pinned_bytes());
    request.hops.push_back(hops_from(graph, node));
  }
  return plan_residency(request);
}

void settle(NodeSetup& node, const Residency& residency) {
  if (node.net.self == node.controller) {
    for (const NodeResidency& worker : residency.nodes)
      node.group_ranks.push_back(worker.group_ranks);
  } else {
    node.pins = residency.nodes[node.net.self.value].pins;
  }
}

namespace {

constexpr double mib = 1024.0 * 1024;

std::string row(const std::string& name, double held, double pinned, double expected,
                const WorkerReport& report) {
  return fmt::format("{:<8} {:>9.2f} {:>10.2f} {:>9.2f} % {:>9.2f} % {:>9} {:>9.2f} {:>9} {:>9}",
                     name, held / mib, pinned / mib, 100 * expected, 100 * report.hit_rate(),
                     report.fetches, static_cast<double>(report.fetched_bytes) / mib, report.builds,
                     report.builds_saved);
}

}  // namespace

std::vector<std::string> residency_table(const Residency& residency,
                                         const std::vector<WorkerReport>& nodes) {
  std::vector<std::string> lines{
      fmt::format("{:<8} {:>9} {:>10} {:>11} {:>11} {:>9} {:>9} {:>9} {:>9}", "node", "held MiB",
                  "pinned MiB", "expected", "hit rate", "fetches", "MiB", "builds", "shared")};
  WorkerReport all;
  double held = 0, expected = 0;
  for (const WorkerReport& report : nodes) {
    const NodeResidency& plan = residency.nodes[report.node.value];
    const auto bytes = static_cast<double>(plan.held_bytes);
    lines.push_back(row(std::to_string(report.node.value), bytes,
                        static_cast<double>(report.pinned_bytes), plan.expected_hit_rate, report));
    held += bytes;
    expected += plan.expected_hit_rate;
    all.add(report);
  }
  // Every node has the same work in the plan.
  const double mean = nodes.empty() ? 1 : expected / static_cast<double>(nodes.size());
  lines.push_back(row("all", held, static_cast<double>(all.pinned_bytes), mean, all));
  return lines;
}

}  // namespace luxodus
