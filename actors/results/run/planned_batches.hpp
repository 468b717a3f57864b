// Looks up a run's batch by its number. Numbers come nearly in order: only when a late lease is
// leased again does the number of an earlier batch come. Thread rule: one thread.
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
