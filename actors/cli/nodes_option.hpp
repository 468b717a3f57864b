// The option --nodes of commands that trace, and need no more of nodes than that they do. One
// thread.
#pragma once

#include "actors/cli/options.hpp"

namespace luxodus::cli {

/// Requires: `nodes` outlives it.
Option nodes_option(int& nodes);

}  // namespace luxodus::cli
