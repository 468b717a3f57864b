// Shortest ways over the free cells of a floor to the nearest of some cells, in any direction:
// Lazy Theta* (Nash, Koenig, Tovey, "Lazy Theta*: any-angle path planning and path length analysis
// in 3D", AAAI 2010), without a heuristic, from the goals over the whole floor. Ways keep to free
// cells. They are as short as any in most cases, and else some percent longer. Immutable once
// made; any thread.
#pragma once

#include <vector>

#include "actors/judge/walkers/free_space.hpp"

namespace luxodus {

class WalkingField {
 public:
  /// Requires: free cells; `space` outlives it. `until`: the search ends once it has this cell, and
  /// knows no way from others.
  WalkingField(const FreeSpace& space, const std::vector<CellNumber>& goals,
               std::optional<CellNumber> until = std::nullopt);

  bool reaches(CellNumber cell) const;
  /// Length of the way from there; infinite if there is none [m].
  double distance_m(CellNumber cell) const;
  /// The cells at which the way turns, from this cell to its goal. Requires: reaches(cell).
  std::vector<CellNumber> way_from(CellNumber cell) const;

 private:
  struct Search;

  const FreeSpace& space_;
  std::vector<float> distance_;     // in cells; negative: not reached
  std::vector<CellNumber> parent_;  // next turn of the way; of a goal itself
};

}  // namespace luxodus
