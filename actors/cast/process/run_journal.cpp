#include "actors/cast/process/run_journal.hpp"

#include <algorithm>

#include "actors/results/run/flux_store.hpp"
#include "runtime/core/log.hpp"
#include "runtime/storage/faulty_store.hpp"

namespace luxodus {

namespace fs = std::filesystem;

namespace {

/// Most disk space reserved for a flux file [bytes]: large ones are mostly zeros, which take none.
constexpr uint64_t max_room = uint64_t{256} << 20;
/// Reserved in addition for the other results.
constexpr uint64_t room_beside = uint64_t{4} << 20;

}  // namespace

Result<std::unique_ptr<RunJournal>> RunJournal::open(const RunJournalConfig& config, LocalRun& run,
                                                     const Clock& clock) {
  std::error_code failed;
  const bool made_folder = fs::create_directories(config.folder, failed);
  RunJournalConfig real = config;
  // Files are not written into a folder that is a link; the folder named in the run's file may be
  // one.
  if (!failed) real.folder = fs::canonical(config.folder, failed);
  if (failed)
    return system_problem(config.folder, "cannot make this folder for the journal", failed.value());
  std::unique_ptr<RunJournal> made(new RunJournal(real, run));
  made->made_folder_ = made_folder;
  const int64_t before = run.traced();
  if (fs::exists(made->snapshot(), failed))
    if (auto ok = load_flux(made->snapshot(), run); !ok) return ok.problem();
  auto file = FileStore::open(made->journal());
  if (!file) return file.problem();
  std::unique_ptr<AppendStore> store = std::move(file).value();
  if (config.faults.any())
    store = std::make_unique<FaultyStore>(std::move(store), config.self, config.faults, clock);
  auto journal = FluxJournal::open(std::move(store), run);
  if (!journal) return problem_in(made->journal(), journal.problem());
  const auto make_snapshot = [path = made->snapshot(), &run]() -> Result<void> {
    return save_flux(path, run);
  };
  made->journal_ = std::make_unique<SnapshotJournal>(
      std::move(journal).value(), SnapshotJournal::Config{config.max_bytes, config.retry},
      make_snapshot, clock);
  made->recovered_ = run.traced() - before;
  made->keep_room();
  return made;
}

void RunJournal::keep_room() {
  const auto groups = static_cast<uint64_t>(run_.totals().groups());
  const auto bins = static_cast<uint64_t>(run_.scene().layout.totals());
  const uint64_t bytes = std::min(max_room, groups * bins * sizeof(Total)) + room_beside;
  if (auto kept = room_.take(config_.folder, bytes); !kept)
    log_warning("journal=no_room text=\"{}\"", kept.problem().text());
}

void RunJournal::rest() {
  room_.release();
  journal_->rest();
  keep_room();
}

void RunJournal::leave_no_trace() {
  if (recovered_ > 0 || journal_->journal().records() > 0) return;
  remove();
  std::error_code not_empty;
  if (made_folder_) fs::remove(config_.folder, not_empty);
}

void RunJournal::remove() {
  std::error_code ignored;  // whatever remains is recognised as a finished run's
  fs::remove(journal(), ignored);
  fs::remove(snapshot(), ignored);
}

}  // namespace luxodus
