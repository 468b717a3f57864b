// Which signs somebody has a clear line to, as the codes look at a building: in clear air, in an
// emergency. `code_mode` judges distances by it and `actors/judge/design` places signs by it, so
// that both see alike. Any thread; one fiber at a time of each access.
#pragma once

#include <optional>
#include <vector>

#include "actors/judge/inspect/building.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

/// The eye of somebody who stands, above the floor [m].
inline constexpr double standing_eye_m = 1.65;

/// A sign seen from an eye: it is not dark, shows a face of which more than half has a clear line
/// to the eye, and no dark pane is between. None where it is not seen. `number` is that of the
/// sign, which need not be in the building. Takes the `view` of it from there.
std::optional<ClearSign> clear_sign(const Building& building, const GeometryAccess& access,
                                    const Sign& sign, uint32_t number, const SignView& view,
                                    const glm::dvec3& eye);

/// By walker, the signs of the scene that he sees.
std::vector<std::vector<ClearSign>> clear_signs(const SceneDescription& scene,
                                                const Building& building,
                                                const std::vector<Walker>& people);

}  // namespace luxodus
