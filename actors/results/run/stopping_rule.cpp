#include "actors/results/run/stopping_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {

const char* name_of(StopReason reason) {
  constexpr const char* names[] = {"particles",   "error",        "time",
                                   "interrupted", "workers lost", "objects lost"};
  return names[static_cast<size_t>(reason)];
}

int64_t StopRule::target_batches(int64_t batch_particles) const {
  if (!particles) return std::numeric_limits<int64_t>::max();
  return (*particles + batch_particles - 1) / batch_particles;
}

int64_t StopRule::next_wait(int64_t batches, int64_t batch_particles, const BatchPlan& plan) const {
  const int64_t target = target_batches(batch_particles);
  return relative_error ? std::min(target, plan.round_end(batches)) : target;
}

std::optional<StopReason> StopRule::reason_to_stop(const RunProgress& run,
                                                   int64_t batch_particles) const {
  if (run.interrupted) return StopReason::interrupted;
  if (run.time_is_up) return StopReason::time;
  if (error_is_reached(run.relative_error)) return StopReason::error;
  if (run.batches >= target_batches(batch_particles)) return StopReason::particles;
  return std::nullopt;
}

Progress progress_of(const StopRule& stop, int64_t batch_particles, int64_t at_start,
                     int64_t batches, double seconds, double error) {
  Progress p;
  p.particles = batches * batch_particles;
  p.seconds = seconds;
  const auto here = static_cast<double>((batches - at_start) * batch_particles);
  p.particles_per_second = seconds > 0 ? here / seconds : 0;
  p.relative_error = error;
  double left = std::numeric_limits<double>::infinity();
  if (stop.seconds) left = std::min(left, *stop.seconds - seconds);
  if (stop.particles && p.particles_per_second > 0)
    left =
        std::min(left, static_cast<double>(*stop.particles - p.particles) / p.particles_per_second);
  if (stop.relative_error && std::isfinite(error) && error > 0) {
    const double ratio = error / *stop.relative_error;
    left = std::min(left, seconds * std::max(0.0, ratio * ratio - 1));
  }
  p.seconds_left =
      std::isfinite(left) ? std::max(0.0, left) : std::numeric_limits<double>::quiet_NaN();
  return p;
}

}  // namespace luxodus
