// Scores of one batch: an integer for each bin of the layout, and the energy balance. The scores
// are a sparse array, so that bins that a batch does not reach take neither memory nor time.
// Thread rule: belongs to one thread.
#pragma once

#include "scenes/light/tally/energy_balance.hpp"
#include "scenes/light/tally/layout.hpp"
#include "scenes/light/tally/sparse_array.hpp"

namespace luxodus {

struct BatchScores {
  SparseArray<int64_t> scores;
  EnergyBalance balance;

  /// Allocates the scores of a layout, or sets existing scores for that layout to zero.
  void reset(const TallyLayout& layout, Cleared cleared = Cleared::kept) {
    if (scores.size() == static_cast<size_t>(layout.scores())) {
      scores.find_touched();
      scores.clear();
    } else {
      scores = SparseArray<int64_t>(layout.scores(), cleared);
    }
    balance = {};
  }
};

}  // namespace luxodus
