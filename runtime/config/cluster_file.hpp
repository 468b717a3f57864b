// Reads the one file that describes a whole cluster. Every problem in it is reported with its line;
// a cluster comes out only where there is none. Keys are those of cluster_schema.hpp. It reads that
// file and no other: paths in it are made whole, relative to its folder, and not looked at. Any
// thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/config/cluster_config.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// A cluster's file [bytes]: 1024 nodes and as many links one by one take a tenth of it.
inline constexpr size_t cluster_file_bytes = size_t{1} << 20;
}  // namespace limits

/// Either a cluster, with warnings that do not hinder, or problems.
struct ReadCluster {
  std::optional<ClusterConfig> cluster;
  Problems problems;
  std::vector<Problem> warnings;
};

ReadCluster read_cluster(const std::filesystem::path& file);

/// The same of a text; `file` is named in problems, and paths are relative to its folder.
ReadCluster parse_cluster(std::string_view text, const std::filesystem::path& file);

/// Either faults, or problems.
struct ReadFaults {
  std::optional<FaultPlan> plan;
  Problems problems;
};

/// A file that holds the table of faults and nothing else, for nodes of these names, by number.
ReadFaults read_fault_file(const std::filesystem::path& file,
                           const std::vector<std::string>& names);

}  // namespace luxodus
