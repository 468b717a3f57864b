// Merging visits the bins on the batch's touched pages in stripes, each behind a lock of its own,
// so that threads that finish together do not wait for each other. A bin without a score in a batch
// adds nothing to sum or squares, so it is skipped.
#include "scenes/light/tally/totals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace luxodus {

namespace {

void add_score(Total& total, int64_t score) {
  if (score == limits::out_of_range) return total.leave_range();
  total.sum += score;
  const int64_t half = int64_t{1} << (Totals::square_shift - 1);
  const Int128 shifted = (static_cast<Int128>(score) + half) >> Totals::square_shift;
  total.add_squares(static_cast<UInt128>(shifted * shifted));
}

}  // namespace

Totals::Totals(const TallyLayout& layout, int groups,
               std::vector<std::vector<int64_t>> photopic_weights, Cleared cleared)
    : layout_(layout), photopic_weights_(std::move(photopic_weights)) {
  groups_.resize(static_cast<size_t>(groups));
  for (GroupState& g : groups_) g.totals = SparseArray<Total>(layout.totals(), cleared);
}

/// Calls visit(first, end) for runs of bins within [first_bin, end_bin) of a block on touched
/// pages, each bin once: a bin on two pages belongs to the first run that reaches it.
template <class Visit>
void Totals::for_each_scored(const BatchScores& batch, const TallyBlock& block, uint32_t first_bin,
                             uint32_t end_bin, Visit&& visit) const {
  const int64_t width = (block.banded ? layout_.bands() : 1) * int64_t{block.quantities};
  int64_t next = first_bin;
  const auto visit_pages = [&](int64_t begin, int64_t end) {
    const int64_t first = std::max(next, (begin - block.first_score) / width);
    next = std::min<int64_t>(end_bin, (end - block.first_score + width - 1) / width);
    if (first < next) visit(static_cast<uint32_t>(first), static_cast<uint32_t>(next));
  };
  batch.scores.for_each_touched(block.first_score + first_bin * width,
                                block.first_score + end_bin * width, visit_pages);
}

void Totals::fill_aggregates(BatchScores& batch, const std::function<void()>& rest) const {
  uint32_t added = 0;
  for (const Aggregate& a : layout_.aggregates()) {
    const TallyBlock& from = layout_.block(a.from_block);
    const TallyBlock& into = layout_.block(a.to_block);
    const size_t bands = static_cast<size_t>(layout_.bands());
    const size_t width = bands * from.quantities;
    const auto add_bins = [&](uint32_t first, uint32_t end) {
      int64_t* to = batch.scores.touch(layout_.score_index(a.to_block, a.to_bin, 0, 0),
                                       static_cast<int64_t>(bands * into.quantities));
      const int64_t* source = batch.scores.data() + layout_.score_index(a.from_block, first, 0, 0);
      added += end - first;
      for (uint32_t bin = first; bin < end; ++bin, source += width) {
        for (size_t b = 0; b < bands; ++b) {
          const int64_t* s = source + b * from.quantities;
          int64_t* t = to + b * into.quantities;
          for (size_t q = 0; q < from.quantities; ++q) t[q] += s[q];
          // A third quantity after (in, out) is the absorbed part.
          if (into.quantities > from.quantities) t[from.quantities] += s[0] - s[1];
        }
      }
    };
    const uint32_t behind = a.first_bin + a.bin_count;
    for (uint32_t first = a.first_bin; first < behind;) {
      const uint32_t end = first + std::min(stripe_bins, behind - first);
      for_each_scored(batch, from, first, end, add_bins);
      first = end;
      if (added < 4 * stripe_bins) continue;
      added = 0;
      rest();
    }
  }
}

void Totals::merge_bins(const BatchScores& batch, GroupState& to, const TallyBlock& block,
                        const std::vector<int64_t>& photopic, uint32_t first_bin,
                        uint32_t end_bin) const {
  const size_t bands = block.banded ? static_cast<size_t>(layout_.bands()) : 1;
  const size_t channels = block.banded ? static_cast<size_t>(layout_.channels()) : 1;
  const size_t quantities = block.quantities;
  const int64_t* score = batch.scores.data() + block.first_score +
                         static_cast<int64_t>(first_bin * bands * quantities);
  const auto scored = [](int64_t s) { return s != 0; };
  const auto width = static_cast<int64_t>(channels * quantities);
  int64_t at = block.first_total + first_bin * width;
  for (uint32_t bin = first_bin; bin < end_bin; ++bin, score += bands * quantities, at += width) {
    if (std::none_of(score, score + bands * quantities, scored)) continue;
    Total* const total = to.totals.touch(at, width);
    for (size_t i = 0; i < bands * quantities; ++i)
      if (score[i] != 0) add_score(total[i], score[i]);
    if (channels == bands) continue;
    for (size_t q = 0; q < quantities; ++q) {
      Int128 weighted = 0;
      for (size_t b = 0; b < bands; ++b) {
        weighted += static_cast<Int128>(score[b * quantities + q]) * photopic[b];
      }
      add_score(total[bands * quantities + q],
                static_cast<int64_t>(weighted >> Totals::photopic_shift));
    }
  }
}

void Totals::merge(BatchScores& batch, int group, const std::function<void()>& rest) {
  batch.scores.find_touched();
  fill_aggregates(batch, rest);
  GroupState& to = groups_[static_cast<size_t>(group)];
  const auto& photopic = photopic_weights_[static_cast<size_t>(group)];
  uint32_t stripe = 0, merged = 0;
  for (const TallyBlock& block : layout_.blocks()) {
    for (uint32_t first = 0; first < block.bins; first += stripe_bins, ++stripe) {
      const auto merge_run = [&](uint32_t from, uint32_t end) {
        const std::lock_guard lock(stripes_[stripe % stripes_.size()]);
        merge_bins(batch, to, block, photopic, from, end);
        merged += end - from;
      };
      for_each_scored(batch, block, first, std::min(block.bins, first + stripe_bins), merge_run);
      if (merged < stripe_bins) continue;
      merged = 0;
      rest();
    }
  }
  const std::lock_guard lock(ledger_mutex_);
  ledger_.add(batch.balance);
  ++to.batches;
}

void Totals::add_bins(int group, int64_t first, std::span<const Total> bins) {
  SparseArray<Total>& totals = groups_[static_cast<size_t>(group)].totals;
  while (!bins.empty()) {
    const int64_t stripe = first / stripe_bins;
    const auto count =
        std::min(bins.size(), static_cast<size_t>((stripe + 1) * stripe_bins - first));
    {
      const std::lock_guard lock(stripes_[static_cast<size_t>(stripe) % stripes_.size()]);
      Total* const to = totals.touch(first, static_cast<int64_t>(count));
      for (size_t i = 0; i < count; ++i) to[i].add(bins[i]);
    }
    bins = bins.subspan(count);
    first += static_cast<int64_t>(count);
  }
}

void Totals::count_batch(int group) {
  const std::lock_guard lock(ledger_mutex_);
  ++groups_[static_cast<size_t>(group)].batches;
}

size_t Totals::bytes() const {
  size_t bytes = 0;
  for (const GroupState& g : groups_) bytes += g.totals.bytes();
  return bytes;
}

size_t Totals::bytes_to_merge(const BatchScores& batch, int group) const {
  const SparseArray<Total>& totals = state(group).totals;
  size_t bytes = 0;
  for (const TallyBlock& block : layout_.blocks()) {
    const int64_t width = (block.banded ? layout_.channels() : 1) * int64_t{block.quantities};
    for_each_scored(batch, block, 0, block.bins, [&](uint32_t first, uint32_t end) {
      bytes +=
          totals.bytes_to_touch(block.first_total + first * width, block.first_total + end * width);
    });
  }
  std::vector<bool> counted(layout_.blocks().size());
  for (const Aggregate& a : layout_.aggregates()) {
    if (counted[a.to_block]) continue;
    counted[a.to_block] = true;
    const TallyBlock& block = layout_.block(a.to_block);
    const int64_t width = (block.banded ? layout_.channels() : 1) * int64_t{block.quantities};
    bytes += totals.bytes_to_touch(block.first_total, block.first_total + block.bins * width);
  }
  return bytes;
}

void Totals::add(const TotalsGain& gain) {
  for (size_t g = 0; g < gain.groups.size(); ++g) {
    GroupState& group = groups_[g];
    group.batches += gain.groups[g].batches;
    for (const TotalsGain::Bin& bin : gain.groups[g].bins)
      group.totals.touch(bin.index)->add(bin.total);
  }
  ledger_.add(gain.balance);
}

namespace {

BatchMean mean_of(const Total& total, int64_t batches) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (batches == 0) return {0, nan};
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!total.in_range()) return {infinite, infinite};
  const auto n = static_cast<double>(batches);
  const double mean = to_double(total.sum) / n;
  if (batches < 2) return {mean, nan};
  const double mean_square = std::ldexp(to_double(total.squares), 2 * Totals::square_shift) / n;
  const double variance = std::max(0.0, mean_square - mean * mean) * n / (n - 1);
  return {mean, std::sqrt(variance / n)};
}

}  // namespace

BatchMean Totals::mean(int group, int64_t total_index) const {
  const GroupState& g = state(group);
  return mean_of(g.totals[static_cast<size_t>(total_index)], g.batches);
}

BatchMean Totals::pooled_mean(int64_t total_index) const {
  Total sum;
  int64_t batches = 0;
  for (const GroupState& g : groups_) {
    sum.add(g.totals[static_cast<size_t>(total_index)]);
    batches += g.batches;
  }
  return mean_of(sum, batches);
}

}  // namespace luxodus
