#include "actors/run/local_run.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "runtime/core/check.hpp"
#include "runtime/core/denormals.hpp"

namespace luxodus {

namespace {

constexpr double report_every_s = 0.25;

}  // namespace

class LocalRun::Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

LocalRun::LocalRun(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads)
    : scene_(std::move(scene)),
      seed_(seed),
      threads_(threads),
      index_(std::make_unique<SceneIndex>(device_, *scene_)),
      rows_(std::make_unique<ResidentParallelFor>(*index_, threads)),
      totals_(scene_->layout, static_cast<int>(scene_->groups.size()), photopic_weights(*scene_)),
      plan_(*scene_),
      error_(std::numeric_limits<double>::quiet_NaN()) {}

LocalRun::LocalRun(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
                   std::unique_ptr<ParallelFor> rows)
    : scene_(std::move(scene)),
      seed_(seed),
      threads_(threads),
      rows_(std::move(rows)),
      totals_(scene_->layout, static_cast<int>(scene_->groups.size()), photopic_weights(*scene_)),
      plan_(*scene_),
      error_(std::numeric_limits<double>::quiet_NaN()) {}

const char* name_of(StopReason reason) {
  constexpr const char* names[] = {"particles",   "error",        "time",
                                   "interrupted", "workers lost", "objects lost"};
  return names[static_cast<size_t>(reason)];
}

void LocalRun::resume(int64_t batches, std::vector<int64_t> missing) {
  plan_.skip(batches);
  missing_ = std::move(missing);
}

Batch LocalRun::next_batch() {
  if (missing_.empty()) return plan_.next();
  BatchPlan from_the_first(*scene_);
  from_the_first.skip(missing_.back());
  missing_.pop_back();
  return from_the_first.next();
}

int64_t LocalRun::target_batches(const StopRule& stop) const {
  if (!stop.particles) return std::numeric_limits<int64_t>::max();
  return (*stop.particles + scene_->batch_particles - 1) / scene_->batch_particles;
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

void LocalRun::trace_until(int64_t end, const StopRule& stop, const std::atomic<bool>& interrupt,
                           const std::function<void(const Progress&)>& report, const Clock& clock) {
  double last_report = clock.seconds();
  const auto work = [&] {
    flush_denormals();
    const auto tracer = make_tracer_(*scene_, GeometryAccess::resident(*index_), seed_);
    BatchScores scores;
    while (true) {
      Batch batch;
      {
        const std::lock_guard lock(plan_mutex_);
        const double now = clock.seconds();
        if (stop.seconds && now >= *stop.seconds) time_is_up_ = true;
        if (interrupt.load() || time_is_up_ || (missing_.empty() && plan_.given() >= end)) return;
        if (pause_is_due()) return;
        if (now - last_report >= report_every_s) {
          last_report = now;
          report(progress(stop, now));
        }
        batch = next_batch();
      }
      scores.reset(scene_->layout);
      tracer->trace(batch.group, batch.first_particle, scene_->batch_particles, scores);
      for (uint32_t unit = 0; unit < tracer->look_units(); ++unit)
        tracer->look(batch.number, unit, scores);
      totals_.merge(scores, batch.group);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < threads_; ++i) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
}

StopReason LocalRun::run(const StopRule& stop, const std::atomic<bool>& interrupt,
                         const std::function<void(const Progress&)>& report) {
  LUX_CHECK(resident(), "threads trace only what is resident");
  const Clock clock;
  const double before = seconds_;
  batches_at_start_ = traced();
  time_is_up_ = false;
  const int64_t target = target_batches(stop);
  StopReason reason = StopReason::particles;
  while (plan_.given() < target || !missing_.empty()) {
    // Rounds end where threads wait for one another: only an error target needs them.
    const int64_t end =
        stop.relative_error ? std::min(target, plan_.round_end(plan_.given())) : target;
    trace_until(end, stop, interrupt, report, clock);
    pause_if_due();
    const bool left = plan_.given() < end || !missing_.empty();
    if (left && !interrupt.load() && !time_is_up_) continue;
    error_ = Readout(*scene_, totals_).worst_relative_error();
    if (interrupt.load())
      reason = StopReason::interrupted;
    else if (time_is_up_)
      reason = StopReason::time;
    else if (stop.relative_error && error_ <= *stop.relative_error)
      reason = StopReason::error;
    else
      continue;
    break;
  }
  seconds_ = before + clock.seconds();
  report(progress(stop, clock.seconds()));
  return reason;
}

}  // namespace luxodus
