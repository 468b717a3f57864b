// Extremes of the illuminance between points of calculation: peaks of narrow beams, dark rings,
// and shadows. Where an extreme may lie is estimated from the luminaires' intensities and the light
// at the points around; what counts is the light computed there. Thread rule: as code_light.hpp.
#pragma once

#include "actors/judge/assess/code_light.hpp"

namespace luxodus {

namespace limits {
/// Places in gaps at which the light is computed, for each extreme of a grid and each set of
/// factors: with the estimate ahead of it, one or two of them usually hold the extreme.
inline constexpr size_t extremes_tried = 48;
/// Places around the darkest points whose gaps may hold a shadow.
inline constexpr size_t shadows_tried = 48;
}  // namespace limits

/// The light at further places of a grid: nearest to each luminaire and its aim, in the middle of
/// gaps beside the darkest points, and where the smallest and largest illuminance may be, for the
/// luminaires' light times each set of factors. Places in bodies are left out. `light`: of `scene`;
/// `lit`: at the places of `grid`, in their order.
std::vector<LitPoint> lit_between(const SceneDescription& scene, const CodeLight& light,
                                  const CalculationGrid& grid, const std::vector<LitPoint>& lit,
                                  const std::vector<LuminaireFactors>& factors);

}  // namespace luxodus
