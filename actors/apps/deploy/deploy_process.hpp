// Properties of a cluster's process for all ways to start it. Pure; any thread.
#pragma once

#include <algorithm>

#include "runtime/config/cluster_config.hpp"

namespace luxodus {

/// The exit code of the controller's process is that of the run.
inline bool hosts_controller(const ClusterConfig& cluster, const ClusterProcess& process) {
  return process.nodes.back() == cluster.controller();
}

/// The controller's process writes the journal, the display's the results; side by side if both are
/// on one host.
inline bool writes_results(const ClusterConfig& cluster, const ClusterProcess& process) {
  const auto& nodes = process.nodes;
  return hosts_controller(cluster, process) ||
         (cluster.is_run() &&
          std::find(nodes.begin(), nodes.end(), cluster.display.node) != nodes.end());
}

/// How long a process may take to end [s]: the steps of a node's end, each with a deadline of its
/// own (EnterPhase in proto/PROTOCOL.md), one more for the rest, and a second.
inline int64_t stop_seconds(const ClusterConfig& cluster) {
  constexpr int steps = 5;
  return cluster.timeouts.shutdown_phase * steps / seconds(1) + 1;
}

}  // namespace luxodus
