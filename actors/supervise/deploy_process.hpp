// What every means of starting a process of a cluster needs to know of it. Pure; any thread.
#pragma once

#include "runtime/config/cluster_config.hpp"

namespace luxodus {

/// The controller's process writes the results.
inline bool hosts_controller(const ClusterConfig& cluster, const ClusterProcess& process) {
  return process.nodes.back() == cluster.controller();
}

/// What a process may take to end [s]: the steps of a node's end, each with a deadline of its own
/// (EnterPhase in proto/PROTOCOL.md), one more for what comes after, and a second.
inline int64_t stop_seconds(const ClusterConfig& cluster) {
  constexpr int steps = 5;
  return cluster.timeouts.shutdown_phase * steps / seconds(1) + 1;
}

}  // namespace luxodus
