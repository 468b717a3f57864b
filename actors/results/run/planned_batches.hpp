// What a batch of a run is, by its number. Numbers come nearly in order; a lease that was late is
// lent again, and asks for one of before. Thread rule: one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "actors/results/run/batch_plan.hpp"

namespace luxodus {

class PlannedBatches {
 public:
  /// Requires: the scene outlives it.
  explicit PlannedBatches(const CompiledScene& scene);

  /// Does not allocate for batches that are near the last one. Requires: number >= 0.
  Batch at(int64_t number);

 private:
  const CompiledScene& scene_;
  BatchPlan plan_;
  std::vector<Batch> recent_;  // what was planned last, by number modulo its size
};

}  // namespace luxodus
