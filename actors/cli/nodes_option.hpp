// The option --nodes of commands that trace, and need no more of nodes than that they do. One
// thread.
#pragma once

#include <memory>

#include "actors/cli/options.hpp"
#include "actors/run/run_executor.hpp"

namespace luxodus::cli {

/// Requires: `nodes` outlives it.
Option nodes_option(int& nodes);

/// Null for 0 nodes: then threads trace.
std::unique_ptr<RunExecutor> nodes_that_trace(int nodes);

}  // namespace luxodus::cli
