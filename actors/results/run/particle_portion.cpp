#include "actors/results/run/particle_portion.hpp"

#include <algorithm>

namespace luxodus {

int64_t trace_portion(BatchTracer& tracer, int group, uint64_t first, int64_t count,
                      uint64_t max_rays, BatchScores& scores) {
  const uint64_t start = scores.balance.rays;
  int64_t traced = 0;
  // Single calls cost little, but not nothing: steps double while their rays are few.
  for (int64_t step = 1; traced < count;) {
    step = std::min(step, count - traced);
    const uint64_t before = scores.balance.rays;
    tracer.trace(group, first + static_cast<uint64_t>(traced), step, scores);
    traced += step;
    const uint64_t rays = scores.balance.rays - start;
    if (rays >= max_rays) break;
    const auto per_particle =
        static_cast<double>(scores.balance.rays - before) / static_cast<double>(step);
    const double expected = 2 * static_cast<double>(step) * per_particle;
    step = expected <= static_cast<double>(max_rays - rays) ? 2 * step : 1;
  }
  return traced;
}

}  // namespace luxodus
