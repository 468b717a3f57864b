// Where luminaires may hang on walls: beside routes and around areas, at one height above the
// floor, where a wall is flat and free. Thread rule: one thread, which has rows run on others.
#pragma once

#include <vector>

#include "actors/judge/design/candidates.hpp"

namespace luxodus {

struct WallSpot {
  glm::dvec3 position{0};       // a little before the wall
  glm::dvec3 outward{1, 0, 0};  // level, of unit length
  glm::dvec3 floor{0};          // of the route or area that it was found from
};

/// Two walls of a room take their own spots. `furnished`: with furniture, which keeps luminaires
/// away as bodies do.
std::vector<WallSpot> wall_spots(const SceneDescription& scene, const DesignSettings& design,
                                 const Building& bare, const Building& furnished,
                                 LeftOut& left_out);

/// Where one on a wall that looks `outward` aims: `aim_deg` from straight down.
glm::dvec3 aim_from_wall(const glm::dvec3& outward, double aim_deg);

}  // namespace luxodus
