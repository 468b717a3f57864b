#include "actors/apps/cli/run_output_files.hpp"

#include <poll.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "actors/apps/cli/picture_choices.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/report_aloud.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/results/pictures/preview.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/core/log.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

/// A disk that is full after hours of work may have room soon: logs a message, and tries again for
/// ten minutes.
Result<void> save_patiently(const fs::path& file, const LocalRun& run) {
  constexpr int tries = 60;
  constexpr int pause_ms = 10'000;
  for (int i = 1;; ++i) {
    auto saved = save_flux(file, run);
    if (saved || i == tries || interrupt_flag()) return saved;
    log_error("{}: tried again in {} s; Ctrl-C ends without", saved.problem().text(),
              pause_ms / 1000);
    for (int slept = 0; slept < pause_ms && !interrupt_flag(); slept += 100)
      ::poll(nullptr, 0, 100);
  }
}

}  // namespace

RunOutputFiles::RunOutputFiles(const LocalRun& base, RunOutputOptions options)
    : base_(base),
      options_(std::move(options)),
      last_checkpoint_(Clock::now()),
      last_preview_(Clock::now()) {}

bool RunOutputFiles::checkpoint_is_due() const {
  return options_.checkpoint_s > 0 && Clock::now() - last_checkpoint_.load() >=
                                          std::chrono::duration<double>(options_.checkpoint_s);
}

bool RunOutputFiles::preview_is_due() const {
  if (options_.preview_asked == nullptr) return false;
  return *options_.preview_asked ||
         (options_.preview_s > 0 &&
          Clock::now() - last_preview_.load() >= std::chrono::duration<double>(options_.preview_s));
}

/// Memory for pictures: sums, now and before the step in progress; light, errors and features of
/// the filter, traced and filtered; for as many pictures as are traced together, and the shared
/// data for choosing emitters.
uint64_t RunOutputFiles::picture_bytes() const {
  constexpr uint64_t floats_of_a_pixel = 2 * (4 + 4 + 1 + picture_features);
  uint64_t sums = 0, largest = 0, pixels = 0;
  for (const Camera& camera : base_.scene().description->cameras) {
    const uint64_t bytes = ViewPasses::bytes_of(camera);
    largest = std::max(largest, bytes);
    sums += bytes;
    pixels += static_cast<uint64_t>(camera.width) * static_cast<uint64_t>(camera.height);
  }
  const uint64_t together = std::max(largest, std::min(sums, limits::max_growing_bytes));
  const double share = sums > 0 ? static_cast<double>(together) / static_cast<double>(sums) : 0;
  const double shown = share * static_cast<double>(pixels * floats_of_a_pixel * sizeof(float));
  const uint64_t sight = sums > 0 ? emitter_sight_bytes(base_.scene()) : 0;
  return together + largest + static_cast<uint64_t>(shown) + sight;
}

void RunOutputFiles::show(const LocalRun& run) {
  if (checkpoint_is_due()) {
    if (run.traced() > 0 && run.particles() > options_.keep_particles) {
      const auto saved = save_checkpoint(options_.folder, run, options_.record, run.seconds(),
                                         !std::exchange(checkpointed_, true));
      if (!saved) log_warning("checkpoint: {}; the run goes on", saved.problem().text());
    }
    last_checkpoint_ = Clock::now();  // set after saving, so that a slow disk leaves time for other
                                      // work
  }
  if (!preview_is_due()) return;
  *options_.preview_asked = false;
  last_preview_ = Clock::now();
  if (run.totals().balance().rays > 0) render_preview(options_.folder, run, options_.preview);
}

/// Whether the folder keeps a longer run.
bool RunOutputFiles::keeps_other(const LocalRun& run, StopReason reason) const {
  return reason == StopReason::interrupted && run.particles() <= options_.keep_particles;
}

Result<void> RunOutputFiles::keep_flux(const LocalRun& run, StopReason reason) {
  if (keeps_other(run, reason)) return {};
  options_.make_room();
  const fs::path file = options_.folder / "flux.lux";
  return options_.patient ? save_patiently(file, run) : save_flux(file, run);
}

Result<void> RunOutputFiles::write_results(const LocalRun& run, StopReason reason) {
  if (keeps_other(run, reason)) return {};
  options_.record.stopped_by = name_of(reason);
  if (auto ok = begin_results(options_.folder, run, options_.record); !ok) return ok;
  const auto report = [&]() -> Result<void> {
    auto result = finish_report_aloud(options_.folder, run, options_.record);
    if (!result) return result.problem();
    result_ = std::move(result).value();
    return {};
  };
  const bool pictures = options_.pictures && !run.scene().description->cameras.empty();
  if (!pictures || reason == StopReason::interrupted) return report();
  // First pictures exist within seconds. Direct light on planes may take longer.
  bool reported = false;
  const auto report_once = [&] {
    reported = true;
    return report();
  };
  std::optional<ProgressLine> line;
  const auto show = [&](const PictureProgress& progress) {
    if (!line) line.emplace("pictures");
    show_pictures(*line, progress);
  };
  const auto rendered = render_views(options_.folder, run, "", options_.picture, show, report_once);
  line.reset();
  if (!reported)
    if (auto ok = report(); !ok) return ok;
  if (!rendered) return rendered.problem();
  tell_flames(run.scene(), options_.picture);
  tell_rendered(rendered.value());
  return {};
}

}  // namespace luxodus::cli
