// Swarm testing: draws fault plans from a seed. Pure; any thread.
#pragma once

#include <vector>

#include "runtime/core/faults.hpp"
#include "runtime/net/net_config.hpp"

namespace luxodus {

/// The system for which a fault plan is drawn.
struct SwarmFrame {
  std::vector<Edge> edges;
  uint16_t nodes = 0;
  /// Nodes that never crash.
  std::vector<NodeId> spared;
  Nanoseconds lasts = seconds(30);  // faults end at this time
};

/// First draws which kinds of fault occur at all, so that every seed has a different mix; then how
/// much of each, and when.
FaultPlan swarm(uint64_t seed, const SwarmFrame& frame);

}  // namespace luxodus
