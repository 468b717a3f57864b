#include "actors/judge/assess/traced_round.hpp"

#include "actors/results/run/run_executor.hpp"

namespace luxodus {

namespace {

/// Factor in compile_scene's number of paths: 0.1 of the particles, divided among the parts.
constexpr double paths_per_particle = 0.1;
/// Parts of a view: see ViewLight.
constexpr size_t parts_of_view = 3;

}  // namespace

double eye_path_factor(int64_t paths, size_t views) {
  // Half a path more, so that rounding down gives this number.
  return (static_cast<double>(paths) + 0.5) * static_cast<double>(parts_of_view * views) /
         (paths_per_particle * static_cast<double>(limits::round_batch_particles));
}

Result<std::unique_ptr<LocalRun>> trace_round(const JudgedScene& judged,
                                              const RoundRequest& request,
                                              const AssessOptions& options,
                                              const std::atomic<bool>& interrupt,
                                              const std::function<void(double share)>& tell) {
  auto compiled = compile_round(judged, request.state);
  if (!compiled) return compiled.problem();
  auto run = std::make_unique<LocalRun>(compiled.value(), request.seed, options.threads);
  StopRule stop;
  stop.particles = request.batches * limits::round_batch_particles;
  RunThreads threads;
  RunExecutor& executor = options.executor == nullptr ? threads : *options.executor;
  executor.enter({request.seed, round_text(request.state)});
  const auto reason = executor.run(*run, stop, interrupt, [&](const Progress& p) {
    tell(static_cast<double>(p.particles) / static_cast<double>(*stop.particles));
  });
  if (!reason) return reason.problem();
  if (reason.value() == StopReason::interrupted) return problem("interrupted");
  return run;
}

int64_t eye_paths_of(const LocalRun& round) {
  return round.batches() * int64_t{round.scene().eye_paths_per_batch} *
         static_cast<int64_t>(parts_of_view * round.scene().eye_targets.size());
}

}  // namespace luxodus
