// Traces batches of particles, with their paths from the eye. Thread rule: one thread or fiber.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "actors/results/run/batch_worker.hpp"
#include "actors/results/run/planned_batches.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

/// Makes a batch tracer: make_batch_tracer, except in a simulation.
using TracerMaker = std::function<std::unique_ptr<BatchTracer>(
    const CompiledScene& scene, const GeometryAccess& access, uint64_t seed)>;

/// How a batch's number is read.
enum class BatchNumbers {
  of_groups,  // BatchRange: a source group, a stream, a number within it; no paths from the eye
  of_run      // the number of a batch of a run (BatchPlan), with its paths from the eye
};

class ParticleWorker final : public BatchWorker {
 public:
  /// A portion is at most `portion` particles and limits::rays_per_portion rays, or one unit of
  /// paths from the eye.
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
  bool cleared_ = false;  // whether the scores are cleared
  Batch batch_;
  int64_t traced_ = 0;   // particles of the batch
  uint32_t looked_ = 0;  // units of its paths from the eye
};

/// Empty totals of a scene.
std::unique_ptr<Totals> empty_totals(const CompiledScene& scene);

}  // namespace luxodus
