// Assigns batches: batch k belongs to one source group and is a fixed range of its particle ids. A
// pure function of the scene, so nodes, threads and resumed runs agree on it without communication.
// A plan is for one thread.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct Batch {
  int64_t number = 0;
  int group = 0;
  uint64_t first_particle = 0;
};

class BatchPlan {
 public:
  explicit BatchPlan(const CompiledScene& scene);

  /// The next batch in order.
  Batch next();
  /// Skips until `count` batches have been given out.
  void skip(int64_t count);
  int64_t given() const { return given_; }
  /// Share of each group in all batches [1].
  const std::vector<double>& shares() const { return share_; }

  /// The end of the first round, or after it the end of the round that contains batch `done`:
  /// rounds grow by a quarter, so that a run exceeds its target by little.
  int64_t round_end(int64_t done) const;

 private:
  std::vector<double> share_;
  std::vector<int64_t> issued_;
  int64_t batch_particles_;
  int64_t given_ = 0;
};

}  // namespace luxodus
