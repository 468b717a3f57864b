// What the line-of-sight method of FDSVismap says of a sign, to be shown beside the verdict: a sign
// is seen from a place on the plan where nothing stands on the level line to it and the visibility
// along that line reaches as far (smoke_laws.hpp). It knows no light, and nothing of what is above
// or below the height of the eye. Called where the building is asked.
#pragma once

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

struct LineOfSight {
  bool clear = false;       // nothing solid is on the level line; panes do not count
  double extinction = 0;    // mean on it, at the wavelength of FDS [1/m]
  double visibility_m = 0;  // with the cosine of the angle of view
  double distance_m = 0;    // on the plan
  bool seen = false;
};

/// Requires: `view` is that of the sign from the eye.
LineOfSight line_of_sight(const Building& building, const GeometryAccess& access, const Sign& sign,
                          const SignView& view, const glm::dvec3& eye);

}  // namespace luxodus
