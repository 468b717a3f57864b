#include "actors/cast/node/node_plan.hpp"

#include <fmt/format.h>

#include "actors/cast/names/role.hpp"
#include "actors/cast/node/residency_setup.hpp"
#include "actors/cast/tally/shard_control.hpp"
#include "actors/cast/tally/tally_shard.hpp"
#include "actors/cast/tracing/tracing_worker.hpp"
#include "runtime/node/node_shell.hpp"

namespace luxodus {

namespace {

std::string mebibytes(uint64_t bytes) {
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

uint64_t bins_of(const CompiledScene& scene) {
  return static_cast<uint64_t>(scene.layout.totals()) * scene.groups.size();
}

/// Bins of all groups in the range of a shard.
uint64_t bins_of(const RunSetup& run, size_t shard) {
  const BinRange bins = run.shards.range(shard, run.scene.layout.totals());
  return static_cast<uint64_t>(bins.end - bins.first) * run.scene.groups.size();
}

void add_mailbox(MemoryPlan& plan, const char* actor, uint64_t bytes) {
  plan.add(fmt::format("mailbox of the {}", actor), bytes,
           "the sum of its limits x the largest of its messages");
}

/// For a worker that holds a shard: a part of each worker's flush, and the totals.
void add_shard(MemoryPlan& plan, const RunSetup& run, size_t shard) {
  const uint64_t bins = bins_of(run, shard);
  const size_t workers = run.graph.workers();
  add_mailbox(plan, "shard of the totals", TallyShard::memory_bytes());
  plan.add("shard of the totals", bins * sizeof(Total),
           fmt::format("{} bins x {} B", bins, sizeof(Total)));
  plan.add(
      "parts of flushes held", workers * bins * flush_bytes_of_bin,
      fmt::format("of {} workers, {} bins x {} B at most each", workers, bins, flush_bytes_of_bin));
}

void add_totals(MemoryPlan& plan, const CompiledScene& scene, uint64_t copies) {
  const uint64_t bytes = bins_of(scene) * sizeof(Total);
  plan.add("totals", copies * bytes,
           fmt::format("{} x {} bins x {} source groups x {} B", copies, scene.layout.totals(),
                       scene.groups.size(), sizeof(Total)));
}

/// For a node that shows the run: a copy of the totals, and memory for its outputs. The scene for
/// rendering belongs to the process.
void add_display(MemoryPlan& plan, const RunSetup& run, const NodeSetup& node) {
  if (node.display == nullptr) return;
  add_mailbox(plan, "display", DisplayActor::memory_bytes());
  const uint64_t bytes = bins_of(run.scene) * sizeof(Total);
  plan.add(
      "totals that are shown", 2 * bytes,
      fmt::format("a copy and the flux file made of it, {} bins x {} source groups x {} B each",
                  run.scene.layout.totals(), run.scene.groups.size(), sizeof(Total)));
  plan.add("pictures", node.display->picture_bytes(),
           "the largest, with its features and errors, and what cells of space know of emitters");
}

uint64_t histogram_bytes(const RunSetup& run) {
  const uint64_t own = 1;  // of batches; those of fetches are counted with the fetcher
  return (own + (run.objects != nullptr ? 2 : 0)) * sizeof(Histogram);
}

/// An upper bound of the readers' copies: a second copy of each number and histogram.
void add_metrics(MemoryPlan& plan, const RunSetup& run, uint64_t histograms) {
  if (run.observation == nullptr) return;
  plan.add("published numbers", histograms * sizeof(Histogram) + 512 * sizeof(uint64_t),
           fmt::format("a copy of {} histograms and some 500 numbers", histograms));
}

MemoryPlan common_plan(const NetConfig& net, const SchedulerLimits& limits) {
  MemoryPlan plan;
  Scheduler::plan_memory(plan, limits);
  Network::plan_memory(plan, net);
  return plan;
}

bool equal(const MemoryPlan& a, const MemoryPlan& b) {
  const auto same = [](const MemoryPlan::Term& x, const MemoryPlan::Term& y) {
    return x.name == y.name && x.bytes == y.bytes && x.derivation == y.derivation;
  };
  return std::equal(a.terms().begin(), a.terms().end(), b.terms().begin(), b.terms().end(), same);
}

MemoryPlan process_plan(const RunSetup& run) {
  MemoryPlan plan;
  const uint64_t cells = run.scene.triangles * sizeof(TriangleRecord);
  const bool mapped = run.scene.description->packed != nullptr;
  if (!mapped || run.index != nullptr)
    plan.add("geometry", cells,
             fmt::format("{} triangles x {} B", run.scene.triangles, sizeof(TriangleRecord)));
  const uint64_t beside = built_bytes_beside_cells(run.scene);
  if (beside > 0 && (!mapped || run.index != nullptr))
    plan.add("smoke data, pictures", beside, "bricks of 16^3 cells and texels, as built");
  if (run.index != nullptr)
    plan.add("search structures", built_bytes_of(cells) - cells,
             "about 111 B a triangle of a cell that is whole here");
  if (run.objects != nullptr && !mapped)
    plan.add("scene parts to serve", run.objects->wire_bytes(),
             fmt::format("{} scene parts as they travel", run.objects->places().size()));
  return plan;
}

/// The first few, and how many more there are.
std::string list_of(const std::vector<std::string>& names) {
  constexpr size_t most = 8;
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), most); ++i)
    text += (text.empty() ? "" : ", ") + names[i];
  return names.size() > most ? text + fmt::format(" and {} more", names.size() - most) : text;
}

}  // namespace

SchedulerLimits worker_limits(const RunSetup& run, const NodeSetup& node) {
  SchedulerLimits limits;
  limits.fibers = node.fibers;
  // One more packs flushes. A coordinator has only one, which counts them.
  const bool coordinates = run.coordinates(node.net.self);
  limits.fibers.count = (coordinates ? 1 : node.photons.fibers) + 1;
  // adds parts of others' flushes
  if (run.shards.shard_of(node.net.self) != 0) ++limits.fibers.count;
  limits.stall = node.stall;
  limits.buggify = node.buggify;
  // Leases, the watch for the end, publishing, and a few spare ones.
  limits.timers_beside_fibers = 16 + PartServer::max_timers(node.fetch);
  return limits;
}

NetConfig controller_net(const RunSetup& run, const NodeSetup& node) {
  NetConfig net = node.net;
  // A round's begin and an answer for each worker; and decisions about flushes.
  const size_t words = 2 * run.tree->children(node.net.self.value).size() +
                       ShardControl::max_decisions * run.shards.owners.size();
  if (words > defaults::outbox_messages) net.outbox_messages = std::max(net.outbox_messages, words);
  return net;
}

NetConfig worker_net(const RunSetup& run, const NodeSetup& node) {
  return run.coordinates(node.net.self) ? controller_net(run, node) : node.net;
}

SchedulerLimits controller_limits(const NodeSetup& node) {
  SchedulerLimits limits;
  limits.fibers = node.fibers;
  limits.fibers.count = 2;  // of the coordinator, which counts flushes, and of the journal
  limits.stall = node.stall;
  limits.buggify = node.buggify;
  return limits;
}

DisplayConfig display_config(const NodeSetup& node) {
  DisplayConfig config;
  config.self = node.net.self;
  config.coordinator = {node.controller, role::coordinator};
  config.lost = node.lost;
  return config;
}

CacheConfig cache_config(const SceneObjects& objects, const NodeSetup& node) {
  return object_cache(objects, node.object_bytes, node.pinned_share);
}

MemoryPlan tally_plan(const CompiledScene& scene, const NodeSetup& node) {
  MemoryPlan plan;
  const uint64_t open = node.photons.batches_in_work();
  const TallyNeed need = tally_need(scene, open);
  if (need.all() > node.tally_bytes) {
    plan.add("tally", node.tally_bytes,
             fmt::format("tally_bytes; all of it would be {}: it flushes when it is full",
                         mebibytes(need.all())));
    return plan;
  }
  plan.add("scores", need.scores,
           fmt::format("{} open batches x {} scores x {} B", open, scene.layout.scores(),
                       sizeof(int64_t)));
  add_totals(plan, scene, 2);
  plan.add("flush", need.flush,
           fmt::format("{} bins x {} source groups x {} B at most, packed less",
                       scene.layout.totals(), scene.groups.size(), flush_bytes_of_bin));
  return plan;
}

/// Flushes of a coordinator's workers, and the totals into which it counts them.
void add_coordinator(MemoryPlan& plan, const RunSetup& run, const NodeSetup& node,
                     uint64_t copies) {
  add_mailbox(plan, "coordinator", Coordinator::memory_bytes());
  add_totals(plan, run.scene, copies);
  const uint64_t bins = bins_of(run, 0);  // other shards count their own
  plan.add("flush being counted", bins * (flush_bytes_of_bin + sizeof(TotalsGain::Bin)),
           fmt::format("{} bins x ({} B packed + {} B read)", bins, flush_bytes_of_bin,
                       sizeof(TotalsGain::Bin)));
  const size_t led = run.tree->children(node.net.self.value).size();
  plan.add("flushes coming in",
           std::min<uint64_t>(ShellConfig{}.max_payload_bytes, led * bins * flush_bytes_of_bin),
           fmt::format("of {} nodes at once, at most {} B of all", led,
                       ShellConfig{}.max_payload_bytes));
}

MemoryPlan worker_plan(const RunSetup& run, const NodeSetup& node) {
  MemoryPlan plan = common_plan(worker_net(run, node), worker_limits(run, node));
  add_mailbox(plan, "tracer", TracingWorker::memory_bytes());
  if (run.coordinates(node.net.self)) {
    add_coordinator(plan, run, node, 2);
    plan.add(
        "flush", bins_of(run.scene) * flush_bytes_of_bin,
        fmt::format("{} bins x {} B at most, packed less", bins_of(run.scene), flush_bytes_of_bin));
  } else {
    plan.add(tally_plan(run.scene, node));
  }
  if (const size_t shard = run.shards.shard_of(node.net.self); shard != 0)
    add_shard(plan, run, shard);
  uint64_t histograms = 2;
  if (run.objects != nullptr) {
    const size_t objects = run.objects->places().size();
    PartServer::plan_memory(plan, node.fetch, cache_config(*run.objects, node), objects);
    histograms += limits::hops + 2;  // by hops from 0, and of waits
  }
  plan.add("histograms", histogram_bytes(run),
           "of batches; of builds and waits where scene parts are fetched");
  add_display(plan, run, node);
  add_metrics(plan, run, histograms);
  if (run.observation != nullptr && run.observation->traces())
    plan.add("trace", limits::trace_events * sizeof(TraceEvent),
             fmt::format("{} events x {} B", limits::trace_events, sizeof(TraceEvent)));
  return plan;
}

MemoryPlan controller_plan(const RunSetup& run, const NodeSetup& node) {
  MemoryPlan plan = common_plan(controller_net(run, node), controller_limits(node));
  add_coordinator(plan, run, node, 1);
  if (run.display)
    plan.add(
        "totals for the display", bins_of(run.scene) * flush_bytes_of_bin,
        fmt::format("{} bins x {} B at most, packed less", bins_of(run.scene), flush_bytes_of_bin));
  add_display(plan, run, node);
  add_metrics(plan, run, 0);
  return plan;
}

Result<void> check_budget(const RunSetup& run, const NodeSetup& node) {
  const std::string name = run.name_of(node.net.self);
  const uint64_t least = min_tally_bytes(run.scene);
  const uint64_t all = tally_need(run.scene, node.photons.batches_in_work()).all();
  if (all > node.tally_bytes && !ZeroedMemory::use_is_told())
    return problem(fmt::format(
        "node {}: its tally needs {}, and tally_bytes is {}; this system does not tell which pages "
        "are in use (/proc/self/pagemap), so it must hold all bins: raise tally_bytes in [budget]",
        name, mebibytes(all), mebibytes(node.tally_bytes)));
  if (least > node.tally_bytes && all > node.tally_bytes)
    return problem(fmt::format(
        "node {}: its tally needs {} at least, and tally_bytes is {}: raise tally_bytes in "
        "[budget], or ask for fewer patches, voxels, bands or source groups",
        name, mebibytes(least), mebibytes(node.tally_bytes)));
  if (run.objects == nullptr) return {};
  const CacheConfig cache = cache_config(*run.objects, node);
  const uint64_t needed = 2 * cache.largest_build_bytes + cache.max_pinned_bytes();
  if (cache.budget_bytes < needed)
    return problem(fmt::format(
        "node {}: its cache needs {}, room for the largest scene part and one more being built, "
        "and object_bytes is {}: raise object_bytes in [budget], or cut the scene into more cells",
        name, mebibytes(needed), mebibytes(cache.budget_bytes)));
  if (run.objects->largest_wire_bytes() > node.fetch.receive_bytes)
    return problem(fmt::format(
        "node {}: the largest scene part has {}, and {} are received at once: cut the scene into "
        "more cells",
        name, mebibytes(run.objects->largest_wire_bytes()), mebibytes(node.fetch.receive_bytes)));
  return {};
}

std::string plan_text(const RunSetup& run, const std::vector<NodeSetup>& workers,
                      const std::optional<NodeSetup>& controller) {
  struct Alike {
    MemoryPlan plan;
    std::vector<std::string> names;
  };
  std::vector<Alike> plans;
  const auto add = [&](const NodeSetup& node, MemoryPlan plan) {
    const std::string name = run.name_of(node.net.self);
    for (Alike& alike : plans)
      if (equal(alike.plan, plan)) return alike.names.push_back(name);
    plans.push_back({std::move(plan), {name}});
  };
  for (const NodeSetup& node : workers) add(node, worker_plan(run, node));
  if (controller) add(*controller, controller_plan(run, *controller));
  std::string text = "process, shared by its nodes:\n" + process_plan(run).table();
  for (const Alike& alike : plans) {
    const size_t nodes = alike.names.size();
    text += nodes == 1 ? fmt::format("node {}:\n", alike.names.front())
                       : fmt::format("each of {} nodes: {}\n", nodes, list_of(alike.names));
    text += alike.plan.table();
  }
  return text;
}

}  // namespace luxodus
