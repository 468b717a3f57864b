// What every means of starting a process of a cluster needs to know of it. Pure; any thread.
#pragma once

#include <algorithm>

#include "runtime/config/cluster_config.hpp"

namespace luxodus {

/// How the controller's process ends says how the run has ended.
inline bool hosts_controller(const ClusterConfig& cluster, const ClusterProcess& process) {
  return process.nodes.back() == cluster.controller();
}

/// The controller's process writes the journal, that of the display the results; beside each other,
/// where they are on one host.
inline bool writes_results(const ClusterConfig& cluster, const ClusterProcess& process) {
  const auto& nodes = process.nodes;
  return hosts_controller(cluster, process) ||
         (cluster.is_run() &&
          std::find(nodes.begin(), nodes.end(), cluster.display.node) != nodes.end());
}

/// What a process may take to end [s]: the steps of a node's end, each with a deadline of its own
/// (EnterPhase in proto/PROTOCOL.md), one more for what comes after, and a second.
inline int64_t stop_seconds(const ClusterConfig& cluster) {
  constexpr int steps = 5;
  return cluster.timeouts.shutdown_phase * steps / seconds(1) + 1;
}

}  // namespace luxodus
