// Scores of one batch: an integer for each bin of the layout, and the energy balance. The scores
// are a sparse array, so that bins that a batch does not reach take neither memory nor time.
// Thread rule: belongs to one thread.
#pragma once

#include <cstdint>
#include <limits>

#include "scenes/light/tally/energy_balance.hpp"
#include "scenes/light/tally/layout.hpp"
#include "scenes/light/tally/sparse_array.hpp"

namespace luxodus {

namespace limits {
/// Events of one history; a longer one counts as lost. With analogue absorption, a closed room of
/// reflectance 0.999 needs about 1000 on average, and 20 000 for one particle in 1e9; albedo 1 in
/// thick fog needs more.
inline constexpr int events_per_history = 1'000'000;
/// Rays of one batch; later particles count as lost. A ray adds at most one birth weight, 2^32, to
/// a score, so no score exceeds 2^63 while a batch has fewer than 2^31 rays. Only unbounded volumes
/// count longer flights, up to 1024 sizes of the scene: to overflow, the million particles that a
/// batch may have would have to fly 2000 sizes each.
inline constexpr uint64_t rays_per_batch = (uint64_t{1} << 31) - events_per_history;
static_assert(unit_weight == uint64_t{1} << 32);
/// The score of a value that no score holds. Totals with one have no mean.
inline constexpr int64_t out_of_range = std::numeric_limits<int64_t>::min();
}  // namespace limits

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
