#include "actors/results/run/local_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "runtime/core/check.hpp"
#include "runtime/core/denormals.hpp"

namespace luxodus {

namespace {

/// Rays between two looks at the clock: a few milliseconds.
constexpr uint64_t rays_of_portion = 20'000;

/// Reaches geometry through another run.
class RowsOfAnother final : public ParallelFor {
 public:
  explicit RowsOfAnother(const ParallelFor& rows) : rows_(rows) {}
  void run(int64_t rows, const MakeWorker& make, const Finished& finished) const override {
    rows_.run(rows, make, finished);
  }

 private:
  const ParallelFor& rows_;
};

}  // namespace

std::unique_ptr<LocalRun> LocalRun::empty_copy() const {
  return std::make_unique<LocalRun>(scene_, seed_, threads_,
                                    std::make_unique<RowsOfAnother>(*rows_));
}

/// How long a stop waits for the batches that have begun. One that takes longer is left out: its
/// particles hardly end.
class LocalRun::Patience {
 public:
  Patience(const StopRule& stop, const std::atomic<bool>& interrupt, std::function<double()> now)
      : stop_(stop), interrupt_(interrupt), now_(std::move(now)) {}

  bool is_over() {
    const double now = now_();
    if (!interrupt_.load() && !stop_.time_is_up(now)) return false;
    if (!asked_at_) asked_at_ = now;
    return now - *asked_at_ > stop_.waits_s;
  }

 private:
  const StopRule& stop_;
  const std::atomic<bool>& interrupt_;
  std::function<double()> now_;
  std::optional<double> asked_at_;  // when it was first seen that the run is to stop
};

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

void LocalRun::resume(int64_t batches, std::vector<int64_t> missing) {
  LUX_CHECK(batches >= plan_.given(), "batches that were given out are counted, or missing");
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

void LocalRun::trace_until(int64_t end, const StopRule& stop, const std::atomic<bool>& interrupt,
                           const std::function<void(const Progress&)>& report, const Clock& clock) {
  double last_report = clock.seconds();
  const auto work = [&] {
    flush_denormals();
    const auto tracer = make_tracer_(*scene_, GeometryAccess::resident(*index_), seed_);
    BatchScores scores;
    Patience patience(stop, interrupt, [&] { return clock.seconds(); });
    while (true) {
      Batch batch;
      {
        const std::lock_guard lock(plan_mutex_);
        const double now = clock.seconds();
        if (stop.time_is_up(now)) time_is_up_ = true;
        if (interrupt.load() || time_is_up_ || (missing_.empty() && plan_.given() >= end)) return;
        if (pause_is_due()) return;
        if (now - last_report >= report_every_s) {
          last_report = now;
          report(progress(stop, now));
        }
        batch = next_batch();
      }
      scores.reset(scene_->layout);
      if (trace_batch(batch, *tracer, patience, scores)) {
        totals_.merge(scores, batch.group);
        continue;
      }
      const std::lock_guard lock(plan_mutex_);
      missing_.push_back(batch.number);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < threads_; ++i) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  std::sort(missing_.begin(), missing_.end());
}

bool LocalRun::trace_batch(const Batch& batch, BatchTracer& tracer, Patience& patience,
                           BatchScores& scores) const {
  // One particle first: it may take half a second where nothing absorbs light.
  int64_t portion = 1;
  for (int64_t traced = 0; traced < scene_->batch_particles;) {
    if (patience.is_over()) return false;
    const int64_t count = std::min(portion, scene_->batch_particles - traced);
    const uint64_t before = scores.balance.rays;
    tracer.trace(batch.group, batch.first_particle + static_cast<uint64_t>(traced), count, scores);
    traced += count;
    if (scores.balance.rays - before < rays_of_portion) portion *= 2;
  }
  for (uint32_t unit = 0; unit < tracer.look_units(); ++unit) {
    if (patience.is_over()) return false;
    tracer.look(batch.number, unit, scores);
  }
  return true;
}

StopReason LocalRun::run(const StopRule& stop, const std::atomic<bool>& interrupt,
                         const std::function<void(const Progress&)>& report) {
  LUX_CHECK(resident(), "threads trace only what is resident");
  const Clock clock;
  const double before = seconds_;
  batches_at_start_ = traced();
  time_is_up_ = false;
  const int64_t batch = scene_->batch_particles;
  StopReason reason = StopReason::particles;
  while (plan_.given() < stop.target_batches(batch) || !missing_.empty()) {
    const int64_t end = stop.next_wait(plan_.given(), batch, plan_);
    trace_until(end, stop, interrupt, report, clock);
    pause_if_due();
    const bool left = plan_.given() < end || !missing_.empty();
    if (left && !interrupt.load() && !time_is_up_) continue;
    error_ = Readout(*scene_, totals_).worst_relative_error();
    const RunProgress here{plan_.given(), error_, interrupt.load(), time_is_up_};
    if (const auto ended = stop.reason_to_stop(here, batch)) {
      reason = *ended;
      break;
    }
  }
  seconds_ = before + clock.seconds();
  report(progress(stop, clock.seconds()));
  return reason;
}

}  // namespace luxodus
