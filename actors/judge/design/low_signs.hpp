// A variant of a layout with low-level signs: copies of signs near the floor, on the wall below or
// beside each. They are added to the high signs, which the codes require, and replace none (ISO
// 16069). Thread rule: as design.hpp.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/inspect/building.hpp"

namespace luxodus {

/// Height of a low sign's centre above the floor, unless the sign is taller [m].
inline constexpr double low_sign_height_m = 0.3;

struct LowSign {
  std::string of;  // name of the high sign
  Sign sign;
};

/// A low sign for each upright sign with a flat wall below it or up to 1.5 m beside it. `building`:
/// the scene without furniture.
std::vector<LowSign> low_signs_of(const SceneDescription& scene, const Building& building);

/// The scene with low-level signs.
SceneDescription with_low_signs(const SceneDescription& scene, const std::vector<LowSign>& low);

}  // namespace luxodus
