// A snapshot of a run's totals, packed in pieces, for a display on any node: nonzero bins, the
// counted and missing batches, and the time that they took. It takes a fraction of the totals'
// memory. Each piece can be requested repeatedly. Thread rule: pack() on any thread while nothing
// is added to the totals; otherwise the node's.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "actors/cast/tally/flush_codec.hpp"
#include "actors/results/run/local_run.hpp"
#include "proto/messages.hpp"
#include "runtime/net/outbox.hpp"

namespace luxodus {

class TotalsSnapshot {
 public:
  TotalsSnapshot(int groups, int64_t totals);

  /// Replaces the previous snapshot. `seconds`: of tracing, in addition to those in `run`.
  void pack(const LocalRun& run, double seconds);
  void forget() { pieces_.clear(); }

  uint32_t pieces() const { return static_cast<uint32_t>(pieces_.size()); }
  /// Header of a piece; the caller sets whether the run is over, and why. Requires: piece <
  /// pieces().
  TotalsShown head(uint32_t piece) const;
  SharedBytes bytes(uint32_t piece) const;

 private:
  struct Piece {
    int64_t first = 0;
    int64_t next = 0;
    std::shared_ptr<const std::vector<std::byte>> bytes;
  };

  FlushEncoder encoder_;
  std::vector<Piece> pieces_;  // the first has the numbers of missing batches
  TotalsShown head_;
};

/// The receiver: a copy of the totals, assembled piece by piece.
class TotalsCopy {
 public:
  /// Requires: `empty` has no totals, and belongs to the same scene.
  explicit TotalsCopy(std::unique_ptr<LocalRun> empty) : run_(std::move(empty)) {}

  /// The number of the next piece.
  uint32_t next() const { return next_; }
  bool whole() const { return pieces_ > 0 && next_ == pieces_; }
  /// Errors: not the next piece of totals of this scene.
  Result<void> take(const TotalsShown& shown, std::span<const std::byte> payload);
  /// Requires: whole().
  std::unique_ptr<LocalRun> run() { return std::move(run_); }
  bool run_is_over() const { return over_; }
  StopReason reason() const { return reason_; }

 private:
  Result<void> take_head(const TotalsShown& shown, std::span<const std::byte> payload);
  Result<void> end();

  std::unique_ptr<LocalRun> run_;
  uint32_t next_ = 0;
  uint32_t pieces_ = 0;  // 0: the first has not arrived
  int64_t next_bin_ = 0;
  int64_t batches_ = 0;
  std::vector<int64_t> missing_;
  LocalRun::Timing timing_;
  bool over_ = false;
  StopReason reason_ = StopReason::particles;
};

}  // namespace luxodus
