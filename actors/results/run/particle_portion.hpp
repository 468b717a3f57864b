// A portion of particles that takes a bounded time. A particle has some ten rays in a usual room,
// and up to limits::events_per_history in a near-white one, so a number of particles bounds no
// time. Any thread, one tracer per thread or fiber; suspends where the tracer does.
#pragma once

#include <cstdint>

#include "scenes/light/tally/batch_scores.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

namespace limits {
/// Rays after which a fiber lets others run: 3 ms at 0.3 us a ray, short against a heartbeat of 250
/// ms, and more than a portion has in usual rooms.
inline constexpr uint64_t rays_per_portion = 10'000;
}  // namespace limits

/// Traces particles from `first` on, at least one and at most `count`, until they have `max_rays`.
/// Returns how many were traced. Requires: count > 0. The scores do not depend on `max_rays`.
int64_t trace_portion(BatchTracer& tracer, int group, uint64_t first, int64_t count,
                      uint64_t max_rays, BatchScores& scores);

}  // namespace luxodus
