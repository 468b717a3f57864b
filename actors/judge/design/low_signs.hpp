// Low-level signs as a variant of a layout: copies of the signs near the floor, on the wall below
// or beside each. They stand beside the signs above, which the codes ask for, and replace none (ISO
// 16069). Thread rule: as design.hpp.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

/// The middle of a low sign is so far above the floor, unless it is taller [m].
inline constexpr double low_sign_height_m = 0.3;

struct LowSign {
  std::string of;  // the sign above it
  Sign sign;
};

/// Of each upright sign with a flat wall below it, or up to 1.5 m beside it. `building`: the scene
/// without furniture.
std::vector<LowSign> low_signs_of(const SceneDescription& scene, const Building& building);

/// The scene with them.
SceneDescription with_low_signs(const SceneDescription& scene, const std::vector<LowSign>& low);

}  // namespace luxodus
