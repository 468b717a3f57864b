#include "actors/judge/thresholds/thresholds.hpp"

namespace luxodus {

Result<ThresholdRows> find_thresholds(const ThresholdSearch& search, Sought sought) {
  if (search.assessed.sights.empty())
    return problem_in(
        search.scene.file,
        "no sign is turned to any place from which people look, so there is nothing to "
        "find: add signs, or routes that pass them");
  switch (sought) {
    case Sought::extinction:
      return find_extinctions(search);
    case Sought::distance:
      return find_distances(search);
    case Sought::height:
      return find_heights(search);
    default:
      return find_faces(search, sought);
  }
}

}  // namespace luxodus
