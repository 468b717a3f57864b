// Totals of each source group, into which batches are merged. All are integers, so the bits do not
// depend on the order of merging or the number of threads. A batch belongs to one source group.
// Totals are sparse arrays: bins that no batch of a group has scored take no memory and no time.
// Thread rule: a BatchScores belongs to one thread; Totals::merge, add_bins and count_batch may be
// called from any thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "runtime/core/wide.hpp"
#include "scenes/light/tally/batch_scores.hpp"

namespace luxodus {

struct Total {
  Int128 sum = 0;
  UInt128 squares = 0;  // of (batch score >> square_shift, rounded); all bits set: out of range

  /// Marks it as holding a score that was out of range, and totals that it is added to.
  void leave_range() { squares = ~UInt128{0}; }
  bool in_range() const { return squares != ~UInt128{0}; }
  void add(const Total& other) {
    sum += other.sum;
    add_squares(other.squares);
  }
  /// Saturates, so that the mark stays whatever is added, in any order.
  void add_squares(UInt128 more) { squares = more > ~squares ? ~UInt128{0} : squares + more; }
};

/// A range [first, end) of bins of totals, for all source groups.
struct BinRange {
  int64_t first = 0;
  int64_t end = 0;
};

/// Increments that batches have made to totals: non-zero bins in ascending order, and the energy
/// balance. Sent from one process to another to be merged into its totals.
struct TotalsGain {
  struct Bin {
    int64_t index = 0;  // into the totals
    Total total;
  };
  struct GroupGain {
    int64_t batches = 0;
    std::vector<Bin> bins;
  };
  std::vector<GroupGain> groups;  // one for each source group
  EnergyBalance balance;
};

/// Mean and standard error of a score per batch; infinite if a score was out of range.
struct BatchMean {
  double mean = 0;
  double standard_error = 0;
};

class Totals {
 public:
  /// Batch scores are divided by 2^12 before they are squared: (2^63 / 2^12)^2 = 2^102 leaves room
  /// for 2^26 batches.
  static constexpr int square_shift = 12;

  /// The photopic channel is (sum over bands of score * weight) / 2^24.
  static constexpr int photopic_shift = 24;

  /// `photopic_weights[group][band]`: integer weights (<= 2^24) of the photopic channel.
  Totals(const TallyLayout& layout, int groups, std::vector<std::vector<int64_t>> photopic_weights,
         Cleared cleared = Cleared::kept);

  /// Fills the aggregate bins of the batch, then adds its scores and their squares to group's
  /// totals.
  void merge(BatchScores& batch, int group) {
    merge(batch, group, [] {});
  }
  /// Merges in steps of some 16 000 bins, a fraction of a millisecond each, and calls `rest`
  /// between them. Totals are those of whole batches only at the end.
  void merge(BatchScores& batch, int group, const std::function<void()>& rest);

  /// Takes bins [first, end) of a group out and leaves zero: calls visit(index, total) for those
  /// that are not zero. Together with take_batches and take_ledger it empties totals piece by
  /// piece. Not concurrent with other calls.
  template <class Visit>
  void take_bins(int group, int64_t first, int64_t end, Visit&& visit) {
    SparseArray<Total>& totals = groups_[static_cast<size_t>(group)].totals;
    totals.for_each_touched(first, end, [&](int64_t begin, int64_t behind) {
      for (int64_t i = begin; i < behind; ++i) {
        const Total total = std::as_const(totals)[static_cast<size_t>(i)];
        if (total.sum == 0 && total.squares == 0) continue;
        visit(i, total);
        *totals.touch(i) = {};
      }
    });
    totals.clear(first, end);
  }
  /// The first bin of a group, at or after `first`, that may be non-zero; the layout's end if there
  /// is none.
  int64_t next_bin(int group, int64_t first) const {
    return state(group).totals.next_touched(first, layout_.totals());
  }
  int64_t take_batches(int group) {
    return std::exchange(groups_[static_cast<size_t>(group)].batches, 0);
  }
  EnergyBalance take_ledger() { return std::exchange(ledger_, {}); }
  /// Adds increments taken from totals of an equal layout. Requires: as many groups, indices within
  /// the layout. Not concurrent with other calls.
  void add(const TotalsGain& gain);

  /// Adds consecutive bins from `first` on, for a batch whose scores are not a BatchScores;
  /// count_batch() then counts the batch. Requires: all lie within the layout.
  void add_bins(int group, int64_t first, std::span<const Total> bins);
  void count_batch(int group);

  int groups() const { return static_cast<int>(groups_.size()); }
  int64_t batches(int group) const { return groups_[static_cast<size_t>(group)].batches; }
  const EnergyBalance& balance() const { return ledger_; }
  const TallyLayout& layout() const { return layout_; }

  /// Memory in use for bins, and the most that merging a batch would add. Requires:
  /// batch.scores.find_touched() was called after the last score.
  size_t bytes() const;
  size_t bytes_to_merge(const BatchScores& batch, int group) const;

  /// Mean and standard error of one score over the batches of a group; the standard error is NaN
  /// for fewer than two batches.
  BatchMean mean(int group, int64_t total_index) const;
  /// Mean and standard error of a value score over the batches of all groups.
  BatchMean pooled_mean(int64_t total_index) const;

  /// Raw state, for the flux file.
  struct GroupState {
    SparseArray<Total> totals;
    int64_t batches = 0;
  };
  const GroupState& state(int group) const { return groups_[static_cast<size_t>(group)]; }
  /// Requires: totals.size() == layout.totals().
  void restore(int group, GroupState state) {
    groups_[static_cast<size_t>(group)] = std::move(state);
  }
  void restore_ledger(const EnergyBalance& balance) { ledger_ = balance; }

 private:
  template <class Visit>
  void for_each_scored(const BatchScores& batch, const TallyBlock& block, uint32_t first_bin,
                       uint32_t end_bin, Visit&& visit) const;
  void fill_aggregates(BatchScores& batch, const std::function<void()>& rest) const;
  void merge_bins(const BatchScores& batch, GroupState& to, const TallyBlock& block,
                  const std::vector<int64_t>& photopic, uint32_t first_bin, uint32_t end_bin) const;

  const TallyLayout& layout_;
  std::vector<GroupState> groups_;
  std::vector<std::vector<int64_t>> photopic_weights_;
  EnergyBalance ledger_;
  static constexpr uint32_t stripe_bins = 1u << 14;
  std::array<std::mutex, 64> stripes_;
  std::mutex ledger_mutex_;
};

}  // namespace luxodus
