#include "actors/supervise/run_journal.hpp"

#include <spdlog/spdlog.h>

#include "actors/source/flux_store.hpp"
#include "runtime/storage/faulty_store.hpp"

namespace luxodus {

namespace fs = std::filesystem;

Result<std::unique_ptr<RunJournal>> RunJournal::open(const RunJournalConfig& config, LocalRun& run,
                                                     const Clock& clock) {
  std::error_code failed;
  std::unique_ptr<RunJournal> made(new RunJournal(config, run));
  made->made_folder_ = fs::create_directories(config.folder, failed);
  if (failed)
    return Problem{{config.folder.string(), 0},
                   "cannot make this folder for the journal: " + failed.message()};
  const int64_t before = run.traced();
  if (fs::exists(made->snapshot(), failed))
    if (auto ok = load_flux(made->snapshot(), run); !ok.ok()) return ok.problem();
  auto file = FileStore::open(made->journal());
  if (!file.ok()) return file.problem();
  std::unique_ptr<AppendStore> store = std::move(file).value();
  if (config.faults.any())
    store = std::make_unique<FaultyStore>(std::move(store), config.self, config.faults, clock);
  auto journal = FluxJournal::open(std::move(store), run);
  if (!journal.ok()) return Problem{{made->journal().string(), 0}, journal.problem().what};
  made->journal_ = std::move(journal).value();
  made->recovered_ = run.traced() - before;
  return made;
}

void RunJournal::rest() {
  // The snapshot has its name before the journal is cut: between the two, what the journal holds is
  // known to be in the snapshot.
  if (auto saved = save_flux(snapshot(), run_); !saved.ok()) {
    spdlog::error("journal=snapshot_failed text=\"{}\"", saved.problem().text());
    return;
  }
  if (auto cut = journal_->restart(); !cut.ok())
    spdlog::error("journal=restart_failed text=\"{}\"", cut.problem().text());
}

void RunJournal::leave_no_trace() {
  if (recovered_ > 0 || journal_->records() > 0) return;
  remove();
  std::error_code not_empty;
  if (made_folder_) fs::remove(config_.folder, not_empty);
}

void RunJournal::remove() {
  std::error_code ignored;  // what is left is taken for what it is: a run that has ended
  fs::remove(journal(), ignored);
  fs::remove(snapshot(), ignored);
}

}  // namespace luxodus
