// The journal of a cluster's controller, beside the results: what it has counted survives it. When
// the node is started again, as by the same command, it goes on from there; when the results are
// written, the journal goes. A journal that has grown long becomes a snapshot of the totals.
//
//   OUT/run.snapshot   a flux file, where there was reason for one
//   OUT/run.journal    flushes since
//
// A disk that fills up: room for a flux file is kept from the start. A flush that the journal
// cannot take is in the totals; so the room is given back, the totals become a snapshot, and the
// journal is cut, which gives room again. Where even that fails it is tried again every so often.
// At the end the room is given back for the results.
//
// Thread rule: as FlushKeeper.
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
  uint64_t max_bytes = 256 << 20;   // then it becomes a snapshot
  Nanoseconds retry = seconds(10);  // between snapshots for want of room
  NodeId self;
  FaultPlan faults;
};

class RunJournal final : public FlushKeeper {
 public:
  /// Makes the folder if need be, and counts into `run` what is kept there. Requires: all outlive
  /// this. Errors: as FileStore::open, load_flux and FluxJournal::open.
  static Result<std::unique_ptr<RunJournal>> open(const RunJournalConfig& config, LocalRun& run,
                                                  const Clock& clock);

  Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte> flush) override {
    return journal_->keep(batches, flush);
  }
  bool is_whole() const override { return journal_->is_whole(); }
  bool rest_is_due() const override { return journal_->rest_is_due(); }
  /// In the room that was kept for it.
  void rest() override;
  /// Gives back the room that was kept: now the results are written.
  void make_room() { room_.release(); }

  /// Batches that were counted before this began.
  int64_t recovered() const { return recovered_; }
  uint64_t torn_bytes() const { return journal_->journal().torn_bytes(); }
  /// The results hold everything: removes both files.
  void remove();
  /// The run did not begin: where nothing was counted, nothing is left.
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
