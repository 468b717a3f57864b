// Who holds which totals of a run: bins in as many contiguous ranges as there are shards, of all
// source groups alike. The first is the controller's, who decides about flushes; the others are
// held by workers. With one shard the controller holds everything.
// Plain values; the same at every node.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/core/ids.hpp"
#include "scenes/light/tally/totals.hpp"

namespace luxodus {

struct ShardPlan {
  std::vector<NodeId> owners;  // of shards 1, 2, ...: different workers

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
  /// The shard that a worker holds; 0 where it holds none.
  size_t shard_of(NodeId worker) const {
    for (size_t i = 0; i < owners.size(); ++i)
      if (owners[i] == worker) return i + 1;
    return 0;
  }
};

}  // namespace luxodus
