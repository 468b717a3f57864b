// Looks up a run's batch by its number. Numbers come nearly in order; a late lease is lent again,
// and asks for an earlier one. Thread rule: one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "actors/results/run/batch_plan.hpp"

namespace luxodus {

class PlannedBatches {
 public:
  /// Requires: the scene outlives it.
  explicit PlannedBatches(const CompiledScene& scene);

  /// Does not allocate for numbers near the last one. Requires: number >= 0.
  Batch at(int64_t number);

 private:
  const CompiledScene& scene_;
  BatchPlan plan_;
  std::vector<Batch> recent_;  // the last planned batches, by number modulo its size
};

}  // namespace luxodus
