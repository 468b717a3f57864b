// Specular reflection of surfaces, sharp or rough, for a live view. Pure; any thread.
#pragma once

#include <array>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Limit on glossy sides in a live view: others are shown matt. Pages read no more.
inline constexpr size_t view_gloss = 4096;
}  // namespace limits

/// One side of a surface of the geometry.
struct LiveGloss {
  uint32_t surface = 0;
  bool back = false;
  std::array<double, 3> mirrored{};  // share of white light reflected in the lobe, linear sRGB
  double spread = 1;                 // share of the side's luminance that is not in the lobe
  double roughness = 0;              // GGX alpha; 0 for a mirror
};

/// The first view_gloss glossy sides and mirrors, in the order of surfaces. A reflectance image
/// counts as white.
std::vector<LiveGloss> gloss_of(const CompiledScene& scene);

}  // namespace luxodus
