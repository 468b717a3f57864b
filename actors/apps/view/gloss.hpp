// What surfaces reflect as a mirror does, more or less sharply, as a live view shows it. Pure; any
// thread.
#pragma once

#include <array>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Sides of a live view at most: others look matt. Pages read no more.
inline constexpr size_t view_gloss = 4096;
}  // namespace limits

/// One side of a surface of the geometry.
struct LiveGloss {
  uint32_t surface = 0;
  bool back = false;
  std::array<double, 3> mirrored{};  // share of white light reflected in the lobe, linear sRGB
  double spread = 1;                 // of the luminance that the side sends out: not in the lobe
  double roughness = 0;              // GGX alpha; 0 of a mirror
};

/// The first view_gloss glossy sides and mirrors, in the order of surfaces. A reflectance picture
/// counts as white.
std::vector<LiveGloss> gloss_of(const CompiledScene& scene);

}  // namespace luxodus
