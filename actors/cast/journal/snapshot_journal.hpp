// A journal that does not grow for ever: when it is long, or lacks a flush that a full disk did not
// take, the totals of the run become a snapshot, and the journal is cut. Where a snapshot fails it
// is tried again every so often. Where snapshots lie is for the owner to say: beside the results,
// or on a simulated disk. Thread rule: as FlushKeeper.
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
    uint64_t max_bytes = 256 << 20;   // then it becomes a snapshot
    Nanoseconds retry = seconds(10);  // between snapshots for want of room
  };
  /// Puts the totals where they outlive the node, whole or not at all.
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
  /// Where the journal is long, or lacks a flush that the totals have.
  bool rest_is_due() const override {
    return (lacks_ || journal_->bytes() >= config_.max_bytes) && clock_.now() >= not_before_;
  }
  /// Makes a snapshot, from which on the journal begins anew.
  void rest() override;

  const FluxJournal& journal() const { return *journal_; }
  uint64_t snapshots() const { return snapshots_; }

 private:
  Result<void> cut();

  const Config config_;
  const std::unique_ptr<FluxJournal> journal_;
  const MakeSnapshot make_snapshot_;
  const Clock& clock_;
  bool lacks_ = false;  // a flush that the totals have
  Nanoseconds not_before_ = 0;
  uint64_t snapshots_ = 0;
};

}  // namespace luxodus
