// The `[[people]]` tables of a scene: whose ways through the building `luxodus walk` follows, and
// how the coordinates and times of their files lie in the scene. Light and packs know nothing of
// them, unless the scene has them stand as bodies. Plain values in SI units; any thread.
// docs/guide/people.md explains it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// A storey in a file without heights: evacuation programs draw storeys beside each other.
struct PeopleStorey {
  glm::dvec2 low{0}, high{0};  // box in the file's coordinates [m]
  double floor_m = 0;          // height of its floor in the scene
  glm::dvec2 shift{0};         // brings the box over the building, before all turns and shifts
};

struct PeopleSettings {
  SourcePlace place;
  std::string name;         // of the group
  std::string file;         // trajectories, resolved path
  double turn_deg = 0;      // about the file's origin, counter-clockwise seen from above; first
  glm::dvec3 shift{0};      // then added to coordinates; z only where the file has heights
  double time_shift_s = 0;  // added to times
  /// Of the only floor in a file without heights; none: 0.
  std::optional<double> floor_m;
  std::vector<PeopleStorey> storeys;   // in a file without heights; empty: there is one floor
  std::optional<double> eye_height_m;  // above the floor; none: the first one of the assessment
  /// Of the view from which the people come; none: that of the assessment.
  std::optional<double> luminance_before_cd_m2;
};

}  // namespace luxodus
