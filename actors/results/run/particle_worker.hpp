// Traces batches of particles, with the paths from the eye that belong to them.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "actors/results/run/batch_worker.hpp"
#include "actors/results/run/planned_batches.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

/// Makes what traces: make_batch_tracer, but in a simulation.
using TracerMaker = std::function<std::unique_ptr<BatchTracer>(
    const CompiledScene& scene, const GeometryAccess& access, uint64_t seed)>;

/// What the number of a batch says.
enum class BatchNumbers {
  of_groups,  // BatchRange: a source group, a stream, a number within it; no paths from the eye
  of_run      // that of a batch of a run (BatchPlan), with its paths from the eye
};

class ParticleWorker final : public BatchWorker {
 public:
  /// A portion is of `portion` particles at most, or one unit of paths from the eye.
  /// Requires: portion >= 1; what is referred to outlives this.
  ParticleWorker(const CompiledScene& scene, const GeometryAccess& access, uint64_t seed,
                 BatchNumbers numbers, int64_t portion,
                 const TracerMaker& make_tracer = make_batch_tracer);

  void begin(const BatchRange& batch) override;
  bool go_on() override;
  void merge_into(Totals& totals, const std::function<void()>& rest) override;

 private:
  Batch batch_of_groups(const BatchRange& batch) const;

  const CompiledScene& scene_;
  const std::unique_ptr<BatchTracer> tracer_;
  std::optional<PlannedBatches> planned_;  // of a run
  const int64_t portion_;
  const uint32_t look_units_;  // of a batch
  BatchScores scores_;
  bool cleared_ = false;  // the scores
  Batch batch_;
  int64_t traced_ = 0;   // particles of it
  uint32_t looked_ = 0;  // units of its paths from the eye
};

/// Totals of a scene, empty.
std::unique_ptr<Totals> empty_totals(const CompiledScene& scene);

}  // namespace luxodus
