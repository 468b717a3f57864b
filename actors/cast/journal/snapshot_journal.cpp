#include "actors/cast/journal/snapshot_journal.hpp"

#include "runtime/core/log.hpp"

namespace luxodus {

Result<void> SnapshotJournal::keep(std::span<const int64_t> batches,
                                   std::span<const std::byte> flush) {
  auto kept = journal_->keep(batches, flush);
  if (!kept) lacks_ = true;
  return kept;
}

/// The snapshot has its final name before the journal is emptied: after a crash between the two,
/// the journal's content is recognised as part of the snapshot.
Result<void> SnapshotJournal::cut() {
  if (auto made = make_snapshot_(); !made) return made.problem();
  ++snapshots_;
  return journal_->restart();
}

void SnapshotJournal::rest() {
  const auto made = cut();
  // Otherwise a disk that stays full would cause a snapshot after every flush.
  if (lacks_ || !made) not_before_ = clock_.now() + config_.retry;
  if (made) {
    if (lacks_) log_info("journal=whole text=\"a snapshot has what the journal lacked\"");
    lacks_ = false;
    return;
  }
  log_error("journal=snapshot_failed text=\"{}: tried again in {:g} s\"", made.problem().text(),
            seconds_in(config_.retry));
}

}  // namespace luxodus
