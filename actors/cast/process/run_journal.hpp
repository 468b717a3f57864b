// The journal of a cluster's controller, beside the results, so that counted work survives a crash.
// A restarted node, by the same command, continues from it; once the results are written, it is
// removed. A long journal is replaced by a snapshot of the totals.
//
//   OUT/run.snapshot   a flux file, if one was necessary
//   OUT/run.journal    flushes since then
//
// Full disks: space for a flux file is reserved from the start. A flush that the journal cannot
// take is in the totals; so the reserve is released, the totals are saved as a snapshot, and the
// journal is emptied, which frees space again. If even that fails it is retried at intervals. At
// the end the reserve is released for the results.
//
// Thread rule: that of FlushKeeper.
#pragma once

#include <filesystem>
#include <memory>

#include "actors/cast/journal/snapshot_journal.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/core/faults.hpp"
#include "runtime/storage/room_reserve.hpp"

namespace luxodus {

struct RunJournalConfig {
  std::filesystem::path folder;
  uint64_t max_bytes = 256 << 20;  // beyond it a snapshot is made
  // between snapshots that fail or are made because the disk is full
  Nanoseconds retry = seconds(10);
  NodeId self;
  FaultPlan faults;
};

class RunJournal final : public FlushKeeper {
 public:
  /// Creates the folder if necessary, and counts the journaled work into `run`. Requires: all
  /// references outlive this. Errors: those of FileStore::open, load_flux and FluxJournal::open.
  static Result<std::unique_ptr<RunJournal>> open(const RunJournalConfig& config, LocalRun& run,
                                                  const Clock& clock);

  Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte> flush) override {
    return journal_->keep(batches, flush);
  }
  bool is_whole() const override { return journal_->is_whole(); }
  bool rest_is_due() const override { return journal_->rest_is_due(); }
  /// Uses the reserved space.
  void rest() override;
  /// Releases the reserved space, so that the results can be written.
  void make_room() { room_.release(); }

  /// Batches that were counted before this process started.
  int64_t recovered() const { return recovered_; }
  uint64_t torn_bytes() const { return journal_->journal().torn_bytes(); }
  /// Removes both files, once the results hold everything.
  void remove();
  /// The run did not begin: if nothing was counted, removes all files.
  void leave_no_trace();

 private:
  RunJournal(const RunJournalConfig& config, LocalRun& run) : config_(config), run_(run) {}
  void keep_room();
  std::filesystem::path snapshot() const { return config_.folder / "run.snapshot"; }
  std::filesystem::path journal() const { return config_.folder / "run.journal"; }

  const RunJournalConfig config_;
  LocalRun& run_;
  RoomReserve room_;
  std::unique_ptr<SnapshotJournal> journal_;
  int64_t recovered_ = 0;
  bool made_folder_ = false;
};

}  // namespace luxodus
