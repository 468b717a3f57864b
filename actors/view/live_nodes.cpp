#include "actors/view/live_nodes.hpp"

#include "scenes/transport/compile.hpp"

namespace luxodus {

LiveNodes::LiveNodes(std::shared_ptr<const SceneDescription> scene) : states_(std::move(scene)) {}

Result<std::unique_ptr<LiveNodes>> LiveNodes::start(std::shared_ptr<const SceneDescription> scene,
                                                    const NodesOptions& options) {
  const auto scenario = find_scenario(*scene, "");
  if (!scenario) return scenario.problem();
  auto compiled = compile_scene(scene, scenario.value(), {1});
  if (!compiled) return compiled.problem();
  std::unique_ptr<LiveNodes> out(new LiveNodes(std::move(scene)));
  LiveNodes& self = *out;
  self.run_ = std::make_unique<LocalRun>(compiled.value(), 1, 1);
  const auto run_id = static_cast<uint64_t>(self.clock_.now()) | 1;
  NodesOptions one_level = options;  // nobody coordinates for another there
  one_level.fan_out = static_cast<uint32_t>(std::max(options.nodes, 2));
  auto nodes = PlannedNodes::make(*self.run_, one_level, {}, run_id);
  if (!nodes) return nodes.problem();
  self.nodes_ = std::move(nodes).value();
  const RunSetup& setup = self.nodes_->setup();
  auto cluster = LiveCluster::start(setup, self.machine_, self.nodes_->controller());
  if (!cluster) return cluster.problem();
  self.cluster_ = std::move(cluster).value();
  self.workers_ = std::make_unique<WorkerThreads>(
      setup, self.machine_, self.nodes_->workers(),
      [&self, stop = options.stop] { return self.ends_.load() || stop(); },
      [&self](const RunSetup& run, const Machine& machine, const NodeSetup& node,
              const std::function<bool()>& stop) {
        return run_live_worker(run, machine, node, stop, self.states_);
      });
  return out;
}

LiveNodes::~LiveNodes() {
  cluster_.reset();
  ends_ = true;
}

}  // namespace luxodus
