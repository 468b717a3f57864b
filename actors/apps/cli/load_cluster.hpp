// Reads a cluster's file for commands that need one. One thread.
#pragma once

#include <filesystem>
#include <optional>

#include "runtime/config/cluster_config.hpp"

namespace luxodus::cli {

/// The cluster of a file, or nothing after every problem was printed. Warnings are logged.
std::optional<ClusterConfig> load_cluster(const std::filesystem::path& file);

}  // namespace luxodus::cli
