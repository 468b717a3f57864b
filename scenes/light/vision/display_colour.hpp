// A colour fitted into a display's gamut (sRGB) without a change of its luminance. Pure functions;
// any thread. The live view's shaders have the same function (actors/apps/view/page/src/draw).
#pragma once

#include <array>

#include "scenes/light/optics/chromaticity.hpp"

namespace luxodus {

/// Linear sRGB, each channel in [0, 1], of luminance `shown` (0 black, 1 white) with the colour of
/// `xyz`. A colour that no display shows at this luminance loses saturation, just as much as
/// needed, and keeps its hue in Oklab (B. Ottosson 2020): its order among other luminances stays.
/// Requires: finite xyz with xyz[1] > 0; 0 <= shown <= 1.
std::array<double, 3> display_colour(const Xyz& xyz, double shown);

}  // namespace luxodus
