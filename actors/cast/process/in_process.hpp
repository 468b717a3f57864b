// A run on several nodes of this process: workers and a controller, each a thread, linked over
// inproc as a minimum-path graph. The flux equals that of the plain loop, bit for bit. Thread rule:
// called from one thread, which becomes the controller's.
#pragma once

#include "actors/cast/process/node_threads.hpp"
#include "actors/cast/process/planned_nodes.hpp"
#include "actors/results/run/run_executor.hpp"

namespace luxodus {

/// Memory plans of the nodes of such a run, as tables. Errors: those of run_on_nodes.
Result<std::string> plan_on_nodes(const LocalRun& run, const NodesOptions& options);

/// Traces until `stop` holds, into `run`'s totals, like LocalRun::run. Errors: no graph with so few
/// links, no sockets left, a budget that is too small.
Result<StopReason> run_on_nodes(LocalRun& run, const NodesOptions& options, const StopRule& stop,
                                const std::atomic<bool>& interrupt,
                                const std::function<void(const Progress&)>& report,
                                NodesReport* counted = nullptr);

/// Nodes that are made for each run, and end with it.
class RunNodes final : public RunExecutor {
 public:
  explicit RunNodes(NodesOptions options) : options_(std::move(options)) {}
  Result<StopReason> run(LocalRun& run, const StopRule& stop, const std::atomic<bool>& interrupt,
                         const std::function<void(const Progress&)>& report) override;

 private:
  const NodesOptions options_;
};

/// This many nodes, with default options. Null for 0 nodes: then the threads of a run trace it.
std::unique_ptr<RunExecutor> nodes_that_trace(int nodes);

}  // namespace luxodus
