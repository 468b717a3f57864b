#include "actors/cli/nodes_option.hpp"

#include "actors/supervise/in_process.hpp"

namespace luxodus::cli {

Option nodes_option(int& nodes) {
  return {"--nodes",
          &nodes,
          "Number of nodes of this process that trace, as those of a cluster do",
          {.otherwise = "none: threads", .range = Range{1, limits::nodes_in_process}}};
}

}  // namespace luxodus::cli
