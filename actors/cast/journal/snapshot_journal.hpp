// A journal of bounded size: when it is long, or lacks a flush because the disk was full, the run's
// totals are saved as a snapshot, and the journal is emptied. A failed snapshot is retried at
// intervals. The owner decides where snapshots are: beside the results, or on a simulated disk.
// Thread rule: that of FlushKeeper.
#pragma once

#include <functional>
#include <memory>

#include "actors/cast/journal/flush_keeper.hpp"
#include "actors/cast/journal/flux_journal.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

class SnapshotJournal final : public FlushKeeper {
 public:
  struct Config {
    uint64_t max_bytes = 256 << 20;  // beyond it a snapshot is made
    // between snapshots that fail or are made because the disk is full
    Nanoseconds retry = seconds(10);
  };
  /// Saves the totals durably and atomically.
  using MakeSnapshot = std::function<Result<void>()>;

  /// Requires: `clock` outlives this.
  SnapshotJournal(std::unique_ptr<FluxJournal> journal, const Config& config,
                  MakeSnapshot make_snapshot, const Clock& clock)
      : config_(config),
        journal_(std::move(journal)),
        make_snapshot_(std::move(make_snapshot)),
        clock_(clock) {}

  Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte> flush) override;
  bool is_whole() const override { return !lacks_; }
  /// Whether the journal is long, or lacks a flush that the totals have.
  bool rest_is_due() const override {
    return (lacks_ || journal_->bytes() >= config_.max_bytes) && clock_.now() >= not_before_;
  }
  /// Makes a snapshot and empties the journal.
  void rest() override;

  const FluxJournal& journal() const { return *journal_; }
  uint64_t snapshots() const { return snapshots_; }

 private:
  Result<void> cut();

  const Config config_;
  const std::unique_ptr<FluxJournal> journal_;
  const MakeSnapshot make_snapshot_;
  const Clock& clock_;
  bool lacks_ = false;  // a flush that is in the totals
  Nanoseconds not_before_ = 0;
  uint64_t snapshots_ = 0;
};

}  // namespace luxodus
