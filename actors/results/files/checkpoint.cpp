// Order: first the maps of the earlier run are removed, then result.json names the current run,
// then its totals replace the earlier ones. If the process ends between two steps, flux.lux is
// still whole, and that of the earlier run.
#include "actors/results/files/checkpoint.hpp"

#include "actors/results/files/result_files.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

Checkpoint::Checkpoint(std::filesystem::path folder, LocalRun& run, RunRecord record,
                       double every_s, int64_t keep_particles)
    : folder_(std::move(folder)),
      run_(run),
      record_(std::move(record)),
      every_(every_s),
      keep_particles_(keep_particles) {
  run_.add_pause(
      this, [this] { return due(); }, [this] { take(); });
}

Checkpoint::~Checkpoint() {
  run_.remove_pause(this);
}

void Checkpoint::take() {
  if (run_.traced() > 0 && run_.particles() > keep_particles_) {
    const auto saved = save();
    if (saved)
      ++taken_;
    else
      log_warning("checkpoint: {}; the run goes on", saved.problem().text());
  }
  last_ = Clock::now();  // set after saving, so that with a slow disk the run still traces in
                         // between
}

Result<void> Checkpoint::save() {
  const double passed = std::chrono::duration<double>(Clock::now() - began_).count();
  return save_checkpoint(folder_, run_, record_, run_.seconds() + passed, taken_ == 0);
}

Result<void> save_checkpoint(const std::filesystem::path& folder, const LocalRun& run,
                             const RunRecord& record, double seconds, bool first) {
  if (first)
    if (auto ok = remove_old_maps(folder); !ok) return ok.problem();
  const Json begun = begun_json(run, record, seconds);
  if (auto ok = write_json(folder / "result.json", begun); !ok) return ok.problem();
  return save_flux(folder / "flux.lux", run);
}

}  // namespace luxodus
