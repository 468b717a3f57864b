// What one batch has scored: an integer for each place of the layout, and where its weight went. A
// sparse array, so that what a batch does not reach takes neither memory nor time.
// Thread rule: belongs to one thread.
#pragma once

#include "scenes/light/tally/energy_balance.hpp"
#include "scenes/light/tally/layout.hpp"
#include "scenes/light/tally/sparse_array.hpp"

namespace luxodus {

struct BatchScores {
  SparseArray<int64_t> scores;
  EnergyBalance balance;

  /// Makes room for a layout's scores, or sets those of the same layout to zero.
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
