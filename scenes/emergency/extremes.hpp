// Smallest, largest and mean illuminance of points of calculation, and checks on them: by the
// points of the grid, and by those between them as well. Internal to the rules of this folder. Pure
// functions; any thread.
#pragma once

#include <limits>

#include "scenes/emergency/rules.hpp"

namespace luxodus {

struct Spread {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  double mean = 0;
  glm::dvec3 darkest{0};

  /// Largest over smallest; infinite if a place has no light at all.
  double diversity() const {
    return least > 0 ? most / least : std::numeric_limits<double>::infinity();
  }
  /// Smallest over largest; 0 without any light.
  double uniformity() const { return most > 0 ? least / most : 0; }
};

/// The mean is that of the grid: points between are not evenly distributed.
struct SpreadInterval {
  Spread grid;
  Spread all;  // with the points between those of the grid
};

/// Illuminance from all luminaires, the light of each times its factor.
Spread spread_of(const std::vector<LitPoint>& points, const LuminaireFactors& factors);
SpreadInterval spread_of(const JudgedPoints& points, const LuminaireFactors& factors);

/// Whether both ends of an interval count as one: they differ by a hundredth at most.
bool is_one_value(double on_grid, double of_all);

/// A check of a number of a spread by the worse end of its interval. Where the two ends differ by
/// more than a hundredth, or in their verdict, the check states that of the grid as well; else its
/// value is that of the grid.
Check judged_between(const Rule& rule, const Subject& subject, const SpreadInterval& spread,
                     double (*number_of)(const Spread&), std::optional<Limit> limit = std::nullopt);

inline double least_of(const Spread& spread) {
  return spread.least;
}
inline double diversity_of(const Spread& spread) {
  return spread.diversity();
}
inline double uniformity_of(const Spread& spread) {
  return spread.uniformity();
}

}  // namespace luxodus
