#include "actors/apps/cli/nodes_option.hpp"

#include "actors/cast/process/in_process.hpp"

namespace luxodus::cli {

Option threads_option(int& threads) {
  return {"--threads",
          &threads,
          "Number of threads",
          {.otherwise = "all cores", .range = Range{1, 1024}}};
}

Option nodes_option(int& nodes) {
  return {"--nodes",
          &nodes,
          "Number of nodes of this process that trace, as those of a cluster do",
          {.otherwise = "none: threads", .range = Range{1, limits::nodes_in_process}}};
}

Result<std::unique_ptr<PictureNodes>> PictureNodes::start(const LocalRun& run, int nodes) {
  std::unique_ptr<PictureNodes> out(new PictureNodes(run));
  NodesOptions options;
  options.nodes = nodes;
  auto started = ProcessExecutor::start(run.shared_scene(), out->states_, options);
  if (!started) return started.problem();
  out->nodes_ = std::move(started).value();
  return out;
}

}  // namespace luxodus::cli
