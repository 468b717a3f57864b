// The line-of-sight method of FDSVismap, shown beside the verdict: a sign is seen if nothing stands
// on the horizontal line to it and the visibility along that line reaches as far as the sign
// (smoke_laws.hpp). The method knows no light, and nothing above or below eye height. Thread rule:
// called within Building::each, with that call's access.
#pragma once

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

struct LineOfSight {
  bool clear = false;       // no solid on the horizontal line; panes do not count
  double extinction = 0;    // mean along the line at the wavelength of FDS [1/m]
  double visibility_m = 0;  // includes the cosine of the angle of view
  double distance_m = 0;    // in plan
  bool seen = false;
};

/// Requires: `view` is the sign as seen from the eye.
LineOfSight line_of_sight(const Building& building, const GeometryAccess& access, const Sign& sign,
                          const SignView& view, const glm::dvec3& eye);

}  // namespace luxodus
