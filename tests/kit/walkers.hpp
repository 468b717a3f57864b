// People who walk, for tests. Pure; any thread.
#pragma once

#include "scenes/formats/trajectories/placed_people.hpp"

namespace luxodus::test {

/// Somebody who is at `from` at 0 s and walks at a constant speed to `to`.
inline PlacedPerson walker_from(const glm::dvec3& from, const glm::dvec3& to, double seconds) {
  PlacedPerson out;
  out.group = "people";
  out.id = 1;
  out.eye_height_m = 1.6;
  out.luminance_before_cd_m2 = 100;
  out.times_s = {0, seconds};
  out.feet = {from, to};
  return out;
}

}  // namespace luxodus::test
