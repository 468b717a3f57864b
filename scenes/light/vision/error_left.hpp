// What the filter of pictures (regression_filter.hpp) will leave of a pixel's error, before it has
// filtered: by how many pixels of a small window are alike, since light is taken from these. At
// edges and in things that fill a pixel or two it leaves most. Pure function; any thread.
#pragma once

#include "scenes/light/vision/likeness.hpp"
#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// Standard errors, one per pixel [cd/m2]. The same for any threads. Requires: width * height
/// pixels.
std::vector<float> error_left(UncertainLight light, int width, int height, double tolerance,
                              const ShareWork& share);

}  // namespace luxodus
