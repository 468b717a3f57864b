// The tally's layout: which quantities are scored, and at which index. A block is an array of bins
// (patches, voxels, cells of a plane, eye paths); a bin holds `quantities` scores for each band. A
// batch scores into one flat array of int64; totals keep, for every score and source group, a
// 128-bit sum and a 128-bit sum of squares over batches. In addition to the bands there is a
// photopic channel: the bands' scores weighted to lumens and summed per batch, because errors of
// bins cannot be combined later. With one band it is that band. Immutable once sealed; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace luxodus {

/// The unit of a score; converted by scenes/light/transport/readout.hpp.
enum class ScoreUnit {
  weight,         // carried flux: watts per unit weight
  weight_length,  // flux times path length: watts metre per unit
  value,          // a physical value, in quanta (transport/value_scores.hpp, `quantum_of`)
};

struct TallyBlock {
  std::string name;
  uint32_t bins = 0;
  uint32_t quantities = 1;
  ScoreUnit unit = ScoreUnit::weight;
  bool banded = true;       // false: one channel, band-free (a value)
  int64_t first_score = 0;  // in a batch's array: [bin][band][quantity]
  int64_t first_total = 0;  // in totals: [bin][channel][quantity]
};

/// A bin of one block that is the sum of consecutive bins of another, per batch: e.g. a wall is the
/// sum of its patches. If the target has one quantity more, it is the first minus the second:
/// absorbed is in minus out.
struct Aggregate {
  uint32_t from_block = 0;
  uint32_t first_bin = 0;
  uint32_t bin_count = 0;
  uint32_t to_block = 0;
  uint32_t to_bin = 0;
};

class TallyLayout {
 public:
  explicit TallyLayout(int bands = 1) : bands_(bands) {}

  /// Adds a block and returns its index.
  uint32_t add_block(TallyBlock block) {
    const uint32_t width = block.banded ? static_cast<uint32_t>(bands_) : 1u;
    const uint32_t channel_width = block.banded ? static_cast<uint32_t>(channels()) : 1u;
    block.first_score = scores_;
    block.first_total = totals_;
    scores_ += int64_t{block.bins} * width * block.quantities;
    totals_ += int64_t{block.bins} * channel_width * block.quantities;
    blocks_.push_back(std::move(block));
    return static_cast<uint32_t>(blocks_.size() - 1);
  }
  void add_aggregate(const Aggregate& a) { aggregates_.push_back(a); }

  int bands() const { return bands_; }
  /// Bands, plus photopic if there is more than one.
  int channels() const { return bands_ == 1 ? 1 : bands_ + 1; }
  int photopic_channel() const { return bands_ == 1 ? 0 : bands_; }
  int64_t scores() const { return scores_; }
  int64_t totals() const { return totals_; }
  const std::vector<TallyBlock>& blocks() const { return blocks_; }
  const TallyBlock& block(uint32_t i) const { return blocks_[i]; }
  const std::vector<Aggregate>& aggregates() const { return aggregates_; }

  int64_t score_index(uint32_t block, uint32_t bin, int band, uint32_t quantity) const {
    const TallyBlock& b = blocks_[block];
    const int64_t width = b.banded ? bands_ : 1;
    return b.first_score + (bin * width + band) * b.quantities + quantity;
  }
  int64_t total_index(uint32_t block, uint32_t bin, int channel, uint32_t quantity) const {
    const TallyBlock& b = blocks_[block];
    const int64_t width = b.banded ? channels() : 1;
    return b.first_total + (bin * width + channel) * b.quantities + quantity;
  }

 private:
  int bands_;
  int64_t scores_ = 0;
  int64_t totals_ = 0;
  std::vector<TallyBlock> blocks_;
  std::vector<Aggregate> aggregates_;
};

}  // namespace luxodus
