// A run's totals at one moment, packed in pieces, for who shows them on whatever node: bins that
// are not zero, the batches that are counted or missing, and the time that they took. Packed they
// are a fraction of what the totals take. Each piece can be asked for again.
// Thread rule: pack() on any thread while nobody adds to the totals; else the node's.
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

  /// Takes the place of what was packed before. `seconds`: of tracing, beside what `run` knows of.
  void pack(const LocalRun& run, double seconds);
  void forget() { pieces_.clear(); }

  uint32_t pieces() const { return static_cast<uint32_t>(pieces_.size()); }
  /// Of a piece; who has run() and how it ended are for others to say. Requires: piece < pieces().
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

/// The other end: a copy of the totals, piece by piece.
class TotalsCopy {
 public:
  /// Requires: `empty` has no totals, and is of the same scene.
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
  uint32_t pieces_ = 0;  // 0: the first has not come
  int64_t next_bin_ = 0;
  int64_t batches_ = 0;
  std::vector<int64_t> missing_;
  LocalRun::Timing timing_;
  bool over_ = false;
  StopReason reason_ = StopReason::particles;
};

}  // namespace luxodus
