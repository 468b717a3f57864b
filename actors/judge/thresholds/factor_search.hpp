// Searches the step of a ladder of smoke densities between which a view passes a limit. Plain
// values; any thread.
#pragma once

#include <map>
#include <optional>

#include "actors/judge/thresholds/crossing.hpp"

namespace luxodus {

/// The ladder: step 0 is the smoke of the scene, and each step is a quarter denser than the one
/// below. The lowest step is clear air.
inline constexpr int densest_step = 15, thinnest_step = -15, clear_air_step = -16;
double factor_of_step(int step);

class FactorSearch {
 public:
  void add(int step, const LevelPoint& point) { known_[step] = point; }
  bool knows(int step) const { return known_.contains(step); }
  /// The next step to look at; none once two neighbouring steps lie on different sides of the
  /// limit, or the whole ladder on one side. Requires: a point.
  std::optional<int> next() const;
  /// The crossing that is nearest to the smoke of the scene, in factors; none if there is none.
  std::optional<Crossing> found() const;
  bool holds_everywhere() const { return known_.begin()->second.holds(); }

 private:
  using Known = std::map<int, LevelPoint>::const_iterator;
  /// The lower of the two points between which the limit is passed nearest to step 0.
  std::optional<Known> bracket() const;

  std::map<int, LevelPoint> known_;  // by step; points are at factors
};

}  // namespace luxodus
