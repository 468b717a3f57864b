#include "actors/cast/process/in_process.hpp"

#include "actors/cast/node/node_plan.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

Result<std::string> plan_on_nodes(const LocalRun& run, const NodesOptions& options) {
  NodesOptions unprofiled = options;
  unprofiled.profile_share = 0;
  auto made = PlannedNodes::make(run, unprofiled, {}, 1);
  if (!made) return made.problem();
  const PlannedNodes& nodes = *made.value();
  return plan_text(nodes.setup(), nodes.workers(), nodes.controller());
}

Result<StopReason> run_on_nodes(LocalRun& run, const NodesOptions& options, const StopRule& stop,
                                const std::atomic<bool>& interrupt,
                                const std::function<void(const Progress&)>& report,
                                NodesReport* counted) {
  // All nodes read objects from one file: if an object is damaged in it, no node can deliver it.
  if (!run.resident())
    if (auto whole = check_objects(run.scene()); !whole) return whole.problem();
  const SystemClock clock;
  auto made = PlannedNodes::make(run, options, stop, static_cast<uint64_t>(clock.now()) | 1);
  if (!made) return made.problem();
  PlannedNodes& nodes = *made.value();
  ZmqContext context({});
  const Machine machine{clock, context};
  const auto run_one = [&](const RunSetup& setup, const Machine& on, const NodeSetup& node,
                           const std::function<bool()>& stops) {
    return run_worker_by(run.make_tracer(), setup, on, node, stops);
  };
  WorkerThreads workers(nodes.setup(), machine, nodes.workers(), options.stop, run_one);
  auto reason = run_controller(
      nodes.setup(), machine, nodes.controller(), {run, stop, interrupt, report},
      [&] { return workers.failed(); }, counted);
  workers.join();
  if (!reason) return reason;
  if (workers.failed()) return workers.problem();
  if (counted != nullptr) {
    counted->workers = workers.report();
    counted->by_node = workers.by_node();
    counted->residency = std::move(nodes.residency());
  }
  return reason;
}

Result<StopReason> RunNodes::run(LocalRun& run, const StopRule& stop,
                                 const std::atomic<bool>& interrupt,
                                 const std::function<void(const Progress&)>& report) {
  return run_on_nodes(run, options_, stop, interrupt, report);
}

std::unique_ptr<RunExecutor> nodes_that_trace(int nodes) {
  if (nodes == 0) return nullptr;
  NodesOptions options;
  options.nodes = nodes;
  return std::make_unique<RunNodes>(options);
}

}  // namespace luxodus
