// Predicts how much error the filter of pictures (regression_filter.hpp) will leave in a pixel:
// from the number of similar pixels in a small window, since the filter averages these. Most error
// remains at edges and in details of a pixel or two. Pure function; any thread.
#pragma once

#include "scenes/light/vision/likeness.hpp"
#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// Standard errors, one per pixel [cd/m2]; independent of the threads used. Requires: width *
/// height pixels.
std::vector<float> error_left(UncertainLight light, int width, int height, double tolerance,
                              const ShareWork& share);

}  // namespace luxodus
