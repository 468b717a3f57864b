// The options --threads and --nodes, for commands that only need these to trace. One thread.
#pragma once

#include <memory>

#include "actors/apps/cli/options.hpp"
#include "actors/cast/process/process_executor.hpp"
#include "actors/results/pictures/picture_tiles.hpp"

namespace luxodus::cli {

/// Requires: the number outlives the option.
Option threads_option(int& threads);
Option nodes_option(int& nodes);

/// Nodes that trace pictures of a finished run.
class PictureNodes {
 public:
  /// Requires: the run outlives them. Errors: as ProcessExecutor::start.
  static Result<std::unique_ptr<PictureNodes>> start(const LocalRun& run, int nodes);
  Executor& executor() { return *nodes_->executor(); }

 private:
  explicit PictureNodes(const LocalRun& run) : states_(run) {}

  PictureStates states_;
  std::unique_ptr<ProcessExecutor> nodes_;
};

}  // namespace luxodus::cli
