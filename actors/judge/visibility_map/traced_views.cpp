#include "actors/judge/visibility_map/traced_views.hpp"

#include <fmt/format.h>

#include <map>
#include <tuple>

#include "actors/results/run/run_executor.hpp"

namespace luxodus {

namespace {

/// Factor in compile_scene's number of paths: 0.1 of the particles, divided among the parts.
constexpr double paths_per_particle = 0.1;

}  // namespace

size_t TracedViews::add(const glm::dvec3& eye, uint32_t sign, bool back) {
  views_.push_back({eye, sign, back, 0, {}});
  return views_.size() - 1;
}

/// Each view has an observer of its own.
RoundState TracedViews::state_of(const std::vector<size_t>& views, int64_t paths) const {
  RoundState out{judged_.scenario.name, judged_.scene.at_s, {}, judged_.signs_apart, 0, {}};
  for (const size_t view : views) {
    Observer& observer = out.observers.emplace_back();
    observer.name = fmt::format("view {}", view);
    observer.eye = views_[view].eye;
    observer.gaze = judged_.scene.signs[views_[view].sign].frame.origin - observer.eye;
    observer.signs = {views_[view].sign};
  }
  const auto parts = static_cast<double>(3 * views.size());
  // Half a path more, so that rounding down gives this number.
  out.eye_path_factor = (static_cast<double>(paths) + 0.5) * parts /
                        (paths_per_particle * static_cast<double>(limits::round_batch_particles));
  return out;
}

void TracedViews::pool(const CompiledScene& scene, const Totals& totals, double paths,
                       const std::vector<size_t>& views) {
  const Readout readout(scene, totals);
  const size_t mixtures = judged_.mixtures().size();
  for (const EyeTarget& target : scene.eye_targets) {
    View& view = views_[views[target.observer]];
    if (scene.signs[target.sign].back != view.back) continue;
    view.light.resize(mixtures);
    for (size_t mixture = 0; mixture < mixtures; ++mixture)
      view.light[mixture].add(read_view(readout, scene, target, mixture), paths);
    view.paths += paths;
  }
}

Result<void> TracedViews::trace(const std::vector<size_t>& views, int64_t paths,
                                const std::atomic<bool>& interrupt,
                                const AssessProgress& progress) {
  if (views.empty()) return {};
  const std::string what = fmt::format("{} views", views.size());
  const RoundState state = state_of(views, paths);
  auto compiled = compile_round(judged_, state);
  if (!compiled) return compiled.problem();
  const uint64_t seed = options_.seed + static_cast<uint64_t>(passes_++);
  LocalRun run(compiled.value(), seed, options_.threads);
  StopRule stop;
  stop.particles = view_batches * limits::round_batch_particles;
  RunThreads threads;
  RunExecutor& executor = options_.executor == nullptr ? threads : *options_.executor;
  executor.enter({seed, round_text(state)});
  const auto reason = executor.run(run, stop, interrupt, [&](const Progress& p) {
    progress(what, static_cast<double>(p.particles) / static_cast<double>(*stop.particles));
  });
  if (!reason) return reason.problem();
  if (reason.value() == StopReason::interrupted) return problem("interrupted");
  all_paths_ += run.batches() * int64_t{run.scene().eye_paths_per_batch} *
                static_cast<int64_t>(3 * run.scene().eye_targets.size());
  if (auto ok = Readout(run.scene(), run.totals()).check_range(); !ok) return ok;
  pool(run.scene(), run.totals(), static_cast<double>(paths * view_batches), views);
  return {};
}

}  // namespace luxodus
