// The states of a scene with a clock that a film passes, each with the flux of a run of its own.
// One thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "actors/cli/finished_run.hpp"
#include "actors/run/local_run.hpp"

namespace luxodus::cli {

class FilmStates {
 public:
  /// A film that begins at `from_s` of the scene's clock and goes on with it. A state holds until
  /// the next of `[time]` begins, and the last one for good. `particles`: of each state.
  /// Errors: the scene has no clock, or another time.
  static Result<FilmStates> make(const FinishedRun& finished, const SceneDescription& scene,
                                 double from_s, double frames_per_s, int64_t particles,
                                 int threads);

  /// Time of the state that a frame is of [s].
  double time_of(size_t frame) const;
  /// The run of a frame's state, which is traced where the frame before was of another; null where
  /// that was interrupted. It stays until the next call. Errors: as scene_of_run.
  Result<const LocalRun*> run_of(size_t frame);

 private:
  FinishedRun finished_;
  TimeSettings clock_;
  double from_s_ = 0, frames_per_s_ = 1;
  int64_t particles_ = 0;
  int threads_ = 1;
  std::optional<double> traced_s_;  // of the state that run_ is of
  std::unique_ptr<LocalRun> run_;
};

}  // namespace luxodus::cli
