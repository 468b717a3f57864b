#include "actors/apps/cli/load_cluster.hpp"

#include "actors/apps/cli/command.hpp"
#include "runtime/config/cluster_file.hpp"

namespace luxodus::cli {

LoadedCluster load_cluster(const std::filesystem::path& file) {
  ReadCluster read = read_cluster(file);
  for (const Problem& problem : read.problems.list()) tell(problem);
  for (const Problem& warning : read.warnings) warn(warning);
  if (!read.cluster) return {std::nullopt, read.problems.kind()};
  return {std::move(read.cluster)};
}

}  // namespace luxodus::cli
