// Which signs a person can see along a free line, by the assumptions of the codes: clear air,
// emergency operation. `code_mode` judges distances with it and `actors/judge/design` places signs
// with it, so both agree. It does not decide whether a sign can be read. Any thread; one fiber at a
// time for each access.
#pragma once

#include <optional>
#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

/// Eye height of a standing person above the floor [m].
inline constexpr double standing_eye_m = 1.65;

/// A sign that an eye sees: the sign is not dark, more than half of the visible face has a free
/// line to the eye, and no dark pane is between. None if it is not seen. `number` is copied into
/// the result; the sign need not be in the building. `view` is the sign as seen from the eye.
std::optional<ClearSign> clear_sign(const Building& building, const GeometryAccess& access,
                                    const Sign& sign, uint32_t number, const SignView& view,
                                    const glm::dvec3& eye);

/// For each walker, the signs of the scene that he sees.
std::vector<std::vector<ClearSign>> clear_signs(const SceneDescription& scene,
                                                const Building& building,
                                                const std::vector<Walker>& people);

}  // namespace luxodus
