#include "actors/results/run/run_in_pieces.hpp"

#include <chrono>
#include <limits>

#include "scenes/light/transport/readout.hpp"

namespace luxodus {

namespace {
using SteadyClock = std::chrono::steady_clock;
}  // namespace

PiecesOfRun::PiecesOfRun(LocalRun& run, int64_t end, std::function<bool()> stops,
                         std::function<void(int64_t)> report)
    : run_(run),
      end_(end),
      stops_(std::move(stops)),
      report_(std::move(report)),
      given_(run.batches()),
      missing_(run.missing().begin(), run.missing().end()) {}

std::unique_ptr<BatchWorker> PiecesOfRun::worker() const {
  const CompiledScene& scene = run_.scene();
  return std::make_unique<ParticleWorker>(scene, GeometryAccess::resident(run_.index()),
                                          run_.seed(), BatchNumbers::of_run, scene.batch_particles,
                                          run_.make_tracer());
}

std::optional<BatchRange> PiecesOfRun::next(int64_t most) {
  if (stops_()) return std::nullopt;
  const std::lock_guard lock(mutex_);
  if (!missing_.empty()) {
    const int64_t first = *missing_.begin();
    missing_.erase(missing_.begin());
    return BatchRange{0, 0, first, 1};
  }
  if (given_ >= end_) return std::nullopt;
  const BatchRange piece{0, 0, given_, std::min(most, end_ - given_)};
  given_ += piece.count;
  return piece;
}

void PiecesOfRun::give_back(const BatchRange& batches) {
  const std::lock_guard lock(mutex_);
  for (int64_t i = 0; i < batches.count; ++i) missing_.insert(batches.first + i);
}

void PiecesOfRun::merged(int64_t batches) {
  const std::lock_guard lock(mutex_);
  merged_ += batches;
}

bool PiecesOfRun::stopped() const {
  int64_t merged = 0;
  {
    const std::lock_guard lock(mutex_);
    merged = merged_;
  }
  report_(merged);
  return stops_();
}

void PiecesOfRun::settle() {
  run_.resume(given_, {missing_.begin(), missing_.end()});
}

Result<StopReason> RunInPieces::run(LocalRun& run, const StopRule& stop,
                                    const std::atomic<bool>& interrupt,
                                    const std::function<void(const Progress&)>& report) {
  const auto began = SteadyClock::now();
  const auto passed_s = [&] {
    return std::chrono::duration<double>(SteadyClock::now() - began).count();
  };
  const int64_t batch = run.scene().batch_particles, at_start = run.traced();
  double error = std::numeric_limits<double>::quiet_NaN(), last_report = 0;
  const auto progress = [&](int64_t batches) {
    return progress_of(stop, batch, at_start, batches, passed_s(), error);
  };
  StopReason reason = StopReason::particles;
  while (run.batches() < stop.target_batches(batch) || !run.missing().empty()) {
    const int64_t end = stop.next_wait(run.batches(), batch, run.plan()), before = run.traced();
    PiecesOfRun pieces(
        run, end, [&] { return interrupt.load() || stop.time_is_up(passed_s()) || !goes_on_(); },
        [&](int64_t merged) {
          if (passed_s() - last_report < report_every_s) return;
          last_report = passed_s();
          report(progress(before + merged));
        });
    executor_.trace(pieces);
    pieces.settle();
    if (auto ok = goes_on_(); !ok) return ok.problem();
    error = Readout(run.scene(), run.totals()).worst_relative_error();
    const RunProgress here{run.batches(), error, interrupt.load(), stop.time_is_up(passed_s())};
    if (const auto ended = stop.reason_to_stop(here, batch)) {
      reason = *ended;
      break;
    }
  }
  run.add_seconds(passed_s());
  report(progress(run.traced()));
  return reason;
}

}  // namespace luxodus
