// Reads a cluster's file for commands that need one. One thread.
#pragma once

#include <filesystem>
#include <optional>

#include "runtime/config/cluster_config.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// A cluster, or none after every problem was told.
struct LoadedCluster {
  std::optional<ClusterConfig> cluster;
  ProblemKind told = ProblemKind::bad_input;  // of the problems together
};

/// The cluster of a file. Warnings are logged.
LoadedCluster load_cluster(const std::filesystem::path& file);

}  // namespace luxodus::cli
