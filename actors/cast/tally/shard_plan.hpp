// Shards of a run's totals: as many contiguous ranges of bins as there are shards, for all source
// groups. The controller, which decides about flushes, holds the first; workers hold the others.
// With one shard the controller holds everything. Plain values, equal at every node; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/core/ids.hpp"
#include "scenes/light/tally/totals.hpp"

namespace luxodus {

struct ShardPlan {
  std::vector<NodeId> owners;  // of shards 1, 2, ...: distinct workers

  size_t shards() const { return owners.size() + 1; }
  /// Requires: shard < shards().
  BinRange range(size_t shard, int64_t totals) const {
    const auto place = [&](size_t n) {
      return totals / static_cast<int64_t>(shards()) * static_cast<int64_t>(n) +
             totals % static_cast<int64_t>(shards()) * static_cast<int64_t>(n) /
                 static_cast<int64_t>(shards());
    };
    return {place(shard), place(shard + 1)};
  }
  /// The shard that a worker holds; 0 if it holds none.
  size_t shard_of(NodeId worker) const {
    for (size_t i = 0; i < owners.size(); ++i)
      if (owners[i] == worker) return i + 1;
    return 0;
  }
};

}  // namespace luxodus
