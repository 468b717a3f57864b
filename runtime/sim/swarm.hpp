// Swarm testing: worlds of faults drawn from a seed.
#pragma once

#include <vector>

#include "runtime/core/faults.hpp"
#include "runtime/net/net_config.hpp"

namespace luxodus {

/// What a world of faults is drawn for.
struct SwarmFrame {
  std::vector<Edge> edges;
  uint16_t nodes = 0;
  /// Nodes that are never crashed.
  std::vector<NodeId> spared;
  Nanoseconds lasts = seconds(30);  // healed from then on
};

/// Which kinds of trouble there are at all is drawn first, so that every seed has a different mix;
/// then how much of each, and when.
FaultPlan swarm(uint64_t seed, const SwarmFrame& frame);

}  // namespace luxodus
