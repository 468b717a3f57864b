// A run on this machine: threads trace batches into the same totals until a stopping rule holds.
// The flux depends on scene, seed and the set of batches only, never on threads or timing. Thread
// rule: one caller, except where a function says otherwise.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "actors/results/run/parallel_for.hpp"
#include "actors/results/run/stopping_rule.hpp"
#include "scenes/light/transport/readout.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

class LocalRun {
 public:
  /// Takes all geometry into memory. Requires: threads >= 1.
  /// Errors (exception): a packed scene whose triangles cannot be read.
  LocalRun(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads);
  /// Does not load geometry: others trace, and what is computed from the result reaches geometry
  /// through `rows`.
  LocalRun(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
           std::unique_ptr<ParallelFor> rows);

  /// Traces until `stop` holds or `interrupt` is set; batches in progress are finished, unless they
  /// take longer than StopRule::waits_s: those are missing(). May be called again to continue.
  /// `report` is called about four times a second, from one thread at a time. Requires: resident().
  StopReason run(const StopRule& stop, const std::atomic<bool>& interrupt,
                 const std::function<void(const Progress&)>& report);

  /// Makes a batch tracer. Called once on each thread.
  using MakeTracer = std::function<std::unique_ptr<BatchTracer>(
      const CompiledScene&, const GeometryAccess&, uint64_t seed)>;
  /// Replaces the program's loop that traces batches.
  void trace_with(MakeTracer make) { make_tracer_ = std::move(make); }
  const MakeTracer& make_tracer() const { return make_tracer_; }

  /// Calls `pause` between batches whenever `due` says so, while nobody adds to the totals and
  /// these hold all batches() except the missing ones: run() calls it on its thread, a coordinator
  /// on one that reads for it. Until remove_pause() with the same owner. Requires: the run does not
  /// continue meanwhile.
  void add_pause(const void* owner, std::function<bool()> due, std::function<void()> pause) {
    pauses_.push_back({owner, std::move(due), std::move(pause)});
  }
  void remove_pause(const void* owner) {
    std::erase_if(pauses_, [owner](const Pause& pause) { return pause.owner == owner; });
  }
  bool pause_is_due() const {
    return std::any_of(pauses_.begin(), pauses_.end(), [](const Pause& p) { return p.due(); });
  }
  void pause_if_due() {
    for (Pause& pause : pauses_)
      if (pause.due()) pause.take();
  }

  /// Continues from totals that hold the first `batches` batches except those `missing`, which are
  /// traced before others. Requires: `missing` ascend and are among them; batches >= batches().
  void resume(int64_t batches, std::vector<int64_t> missing = {});
  /// Adds time in which others have traced into the totals.
  void add_seconds(double seconds) { seconds_ += seconds; }
  /// Marks the time of the totals as unknown: rates count what is traced from here on.
  void forget_time() { untimed_ = {traced(), totals_.balance().rays}; }
  /// Sets the time of the batches resumed from, which is known after all.
  void add_earlier_seconds(double seconds) {
    seconds_ += seconds;
    untimed_ = {};
  }

  /// The known timing of the totals, to copy to another run.
  struct Timing {
    double seconds = 0;
    int64_t untimed_batches = 0;  // resumed from, with unknown time
    uint64_t untimed_rays = 0;
  };
  Timing timing() const { return {seconds_, untimed_.batches, untimed_.rays}; }
  void set_timing(const Timing& timing) {
    seconds_ = timing.seconds;
    untimed_ = {timing.untimed_batches, timing.untimed_rays};
  }

  /// A run of the same scene without totals, which shares this one's access to geometry.
  /// Requires: this outlives it.
  std::unique_ptr<LocalRun> empty_copy() const;

  /// The batches of the run, and the ends of its rounds.
  const BatchPlan& plan() const { return plan_; }

  const CompiledScene& scene() const { return *scene_; }
  const std::shared_ptr<const CompiledScene>& shared_scene() const { return scene_; }
  bool resident() const { return index_ != nullptr; }
  /// Requires: resident().
  const SceneIndex& index() const { return *index_; }
  /// For other work that needs geometry.
  const ParallelFor& rows() const { return *rows_; }
  Totals& totals() { return totals_; }
  const Totals& totals() const { return totals_; }
  const EmbreeDevice& device() const { return device_; }
  /// Batches given out so far, and those of them that the totals lack, because nodes were lost or a
  /// stop did not wait for them.
  int64_t batches() const { return plan_.given(); }
  const std::vector<int64_t>& missing() const { return missing_; }
  int64_t traced() const { return plan_.given() - static_cast<int64_t>(missing_.size()); }
  int64_t particles() const { return traced() * scene_->batch_particles; }
  double seconds() const { return seconds_; }
  /// The particles, and their rays, that took seconds().
  int64_t timed_particles() const {
    return particles() - untimed_.batches * scene_->batch_particles;
  }
  uint64_t timed_rays() const { return totals_.balance().rays - untimed_.rays; }
  uint64_t seed() const { return seed_; }
  int threads() const { return threads_; }

 private:
  class Clock;
  class Patience;
  Batch next_batch();
  void trace_until(int64_t end, const StopRule& stop, const std::atomic<bool>& interrupt,
                   const std::function<void(const Progress&)>& report, const Clock& clock);
  /// Traces a batch in portions; false if the run was to stop and the batch took too long.
  bool trace_batch(const Batch& batch, BatchTracer& tracer, Patience& patience,
                   BatchScores& scores) const;
  Progress progress(const StopRule& stop, double seconds) const {
    return progress_of(stop, scene_->batch_particles, batches_at_start_, traced(), seconds, error_);
  }

  std::shared_ptr<const CompiledScene> scene_;
  uint64_t seed_;
  int threads_;
  EmbreeDevice device_;
  std::unique_ptr<SceneIndex> index_;
  std::unique_ptr<ParallelFor> rows_;
  Totals totals_;
  BatchPlan plan_;
  std::vector<int64_t> missing_;
  std::mutex plan_mutex_;
  std::atomic<bool> time_is_up_{false};
  double seconds_ = 0;
  struct Untimed {
    int64_t batches = 0;
    uint64_t rays = 0;
  };
  Untimed untimed_;  // resumed from, with unknown time
  double error_ = 0;
  int64_t batches_at_start_ = 0;
  MakeTracer make_tracer_ = make_batch_tracer;
  struct Pause {
    const void* owner;
    std::function<bool()> due;
    std::function<void()> take;
  };
  std::vector<Pause> pauses_;
};

}  // namespace luxodus
