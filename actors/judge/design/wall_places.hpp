// Places for luminaires on walls: beside routes and around areas, at one height above the floor,
// where a wall is flat and free. Thread rule: one thread, which has rows computed by others.
#pragma once

#include <vector>

#include "actors/judge/design/candidates.hpp"

namespace luxodus {

struct WallSpot {
  glm::dvec3 position{0};       // slightly in front of the wall
  glm::dvec3 outward{1, 0, 0};  // horizontal unit vector
  glm::dvec3 floor{0};          // of the route or area beside it
};

/// Each wall of a room gets its own spots. `furnished`: with furniture, which excludes luminaires
/// as bodies do.
std::vector<WallSpot> wall_spots(const SceneDescription& scene, const DesignSettings& design,
                                 const Building& bare, const Building& furnished,
                                 LeftOut& left_out);

/// Aim of a luminaire on a wall that faces `outward`: `aim_deg` from straight down.
glm::dvec3 aim_from_wall(const glm::dvec3& outward, double aim_deg);

}  // namespace luxodus
