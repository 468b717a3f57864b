// Reads a cluster file. Every problem in it is reported with its line; a cluster is returned only
// if there is none. Keys are those of cluster_schema.hpp. It reads no other file: paths are
// resolved relative to the file's folder, and their targets are not checked. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/config/cluster_config.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Longest cluster file [bytes]: 1024 nodes and as many single links take a tenth of it.
inline constexpr size_t cluster_file_bytes = size_t{1} << 20;
}  // namespace limits

/// A cluster, possibly with warnings, or problems.
struct ReadCluster {
  std::optional<ClusterConfig> cluster;
  Problems problems;
  std::vector<Problem> warnings;
};

ReadCluster read_cluster(const std::filesystem::path& file);

/// Parses a text; problems name `file`, and paths are relative to its folder.
ReadCluster parse_cluster(std::string_view text, const std::filesystem::path& file);

/// A fault plan, or problems.
struct ReadFaults {
  std::optional<FaultPlan> plan;
  Problems problems;
};

/// Reads a file that holds only the table of faults, for nodes with these names, by number.
ReadFaults read_fault_file(const std::filesystem::path& file,
                           const std::vector<std::string>& names);

}  // namespace luxodus
