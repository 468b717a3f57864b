#include "actors/cast/process/process_executor.hpp"

#include <algorithm>

namespace luxodus {

ProcessExecutor::ProcessExecutor(std::shared_ptr<const CompiledScene> scene)
    : run_(std::move(scene), 1, 1) {}

Result<std::unique_ptr<ProcessExecutor>> ProcessExecutor::start(
    std::shared_ptr<const CompiledScene> scene, StateMaker& states, const NodesOptions& options) {
  std::unique_ptr<ProcessExecutor> out(new ProcessExecutor(std::move(scene)));
  ProcessExecutor& self = *out;
  const auto run_id = static_cast<uint64_t>(self.clock_.now()) | 1;
  NodesOptions one_level = options;  // without sub-coordinators
  one_level.fan_out = static_cast<uint32_t>(std::max(options.nodes, 2));
  auto nodes = PlannedNodes::make(self.run_, one_level, {}, run_id);
  if (!nodes) return nodes.problem();
  self.nodes_ = std::move(nodes).value();
  self.setup_.emplace(self.nodes_->setup()).states = &states;
  auto executor = NodeExecutor::start(*self.setup_, self.machine_, self.nodes_->controller());
  if (!executor) return executor.problem();
  self.executor_ = std::move(executor).value();
  self.workers_ = std::make_unique<WorkerThreads>(
      *self.setup_, self.machine_, self.nodes_->workers(),
      [&self, stop = options.stop] { return self.ends_.load() || stop(); });
  return out;
}

ProcessExecutor::~ProcessExecutor() {
  executor_.reset();
  ends_ = true;
}

}  // namespace luxodus
