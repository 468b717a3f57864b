#include "actors/cli/film_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/cli/signals.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

Result<FilmStates> FilmStates::make(const FinishedRun& finished, const SceneDescription& scene,
                                    double from_s, double frames_per_s, int64_t particles,
                                    int threads) {
  if (!scene.time)
    return problem_in(scene.file, "--from is of scenes that change: this one has no [time]");
  if (from_s < scene.time->from_s || from_s > scene.time->to_s)
    return problem_in(scene.time->place,
                      fmt::format("--from {:g}s is not within the scene's time, {:g} s to {:g} s",
                                  from_s, scene.time->from_s, scene.time->to_s));
  FilmStates out;
  out.finished_ = finished;
  out.clock_ = *scene.time;
  out.from_s_ = from_s;
  out.frames_per_s_ = frames_per_s;
  out.particles_ = particles;
  out.threads_ = threads;
  return out;
}

double FilmStates::time_of(size_t frame) const {
  const double now = from_s_ + static_cast<double>(frame) / frames_per_s_;
  // A frame at the beginning of a state but for rounding is of it.
  const double steps = std::floor((now - clock_.from_s) / clock_.step_s * (1 + 1e-12));
  return std::min(clock_.from_s + steps * clock_.step_s, clock_.to_s);
}

Result<const LocalRun*> FilmStates::run_of(size_t frame) {
  const double time_s = time_of(frame);
  if (traced_s_ == time_s) return run_.get();
  FinishedRun at_time = finished_;
  at_time.at_s = time_s;
  // Of particles dealt by need the shares are those of another state.
  at_time.batch_shares.clear();
  auto scene = scene_of_run(at_time);
  if (!scene) return scene.problem();
  // The former one goes when this one is there: a film tells them apart by their addresses.
  run_ = std::make_unique<LocalRun>(scene->scene, finished_.seed, threads_);
  traced_s_ = time_s;
  StopRule stop;
  stop.particles = particles_;
  log_info("film: tracing the state at {:g} s", time_s);
  run_->run(stop, interrupt_flag(), [](const Progress&) {});
  if (interrupt_flag()) return static_cast<const LocalRun*>(nullptr);
  return run_.get();
}

}  // namespace luxodus::cli
