#include "actors/source/snapshot_journal.hpp"

#include <spdlog/spdlog.h>

namespace luxodus {

Result<bool> SnapshotJournal::keep(std::span<const int64_t> batches,
                                   std::span<const std::byte> flush) {
  auto kept = journal_->keep(batches, flush);
  if (!kept.ok()) lacks_ = true;
  return kept;
}

/// The snapshot has its name before the journal is cut: between the two, what the journal holds is
/// known to be in the snapshot.
Result<bool> SnapshotJournal::cut() {
  if (auto made = make_snapshot_(); !made.ok()) return made.problem();
  ++snapshots_;
  return journal_->restart();
}

void SnapshotJournal::rest() {
  const auto made = cut();
  // A disk that stays full would have a snapshot made after every flush.
  if (lacks_ || !made.ok()) not_before_ = clock_.now() + config_.retry;
  if (made.ok()) {
    if (lacks_) spdlog::info("journal=whole text=\"a snapshot has what the journal lacked\"");
    lacks_ = false;
    return;
  }
  spdlog::error("journal=snapshot_failed text=\"{}: tried again in {:g} s\"", made.problem().text(),
                static_cast<double>(config_.retry) * 1e-9);
}

}  // namespace luxodus
