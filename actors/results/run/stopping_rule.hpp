// When a run stops, and how far it is from stopping. Both threads of one process and the controller
// of many nodes use it, so that a run ends at the same batch on any number of them. Pure; any
// thread.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/results/run/batch_plan.hpp"

namespace luxodus {

enum class StopReason { particles, error, time, interrupted, workers_lost, objects_lost };

/// The name of a reason in results and logs.
const char* name_of(StopReason reason);

/// Progress of a run at a point where all its threads or nodes wait for one another.
struct RunProgress {
  int64_t batches = 0;  // complete ones, from the first on
  double relative_error = 0;
  bool interrupted = false;
  bool time_is_up = false;
};

/// When to stop: at the first limit that is reached. Particles are rounded up to whole batches; the
/// error is tested at the ends of rounds.
struct StopRule {
  std::optional<int64_t> particles;
  std::optional<double> relative_error;
  std::optional<double> seconds;
  /// How long a stop by time or by an interrupt waits for batches in progress [s]: many times as
  /// long as most take, but a batch in which hardly any light is absorbed takes minutes.
  double waits_s = 5;

  /// Number of batches for `particles`; unreachably many without it.
  int64_t target_batches(int64_t batch_particles) const;
  /// The next wait of threads or nodes for one another after `batches`: at the end of a round,
  /// which only an error target needs, or at the target.
  int64_t next_wait(int64_t batches, int64_t batch_particles, const BatchPlan& plan) const;
  bool time_is_up(double passed_s) const { return seconds && passed_s >= *seconds; }
  bool error_is_reached(double error) const { return relative_error && error <= *relative_error; }
  /// Why the run ends here; nothing if it goes on.
  std::optional<StopReason> reason_to_stop(const RunProgress& run, int64_t batch_particles) const;
};

inline constexpr double report_every_s = 0.25;

/// Progress reported while a run goes on.
struct Progress {
  int64_t particles = 0;
  double seconds = 0;
  double particles_per_second = 0;
  double relative_error = 0;  // NaN until a round has ended
  double seconds_left = 0;    // NaN if no rule gives one
};

/// Progress after `batches` in all, of which `at_start` existed before these `seconds`.
Progress progress_of(const StopRule& stop, int64_t batch_particles, int64_t at_start,
                     int64_t batches, double seconds, double error);

}  // namespace luxodus
