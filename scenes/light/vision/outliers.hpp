// Single bright paths in a traced picture: their light is spread over pixels that are like theirs,
// and none of it is lost (H. E. Rushmeier and G. J. Ward, "Energy preserving non-linear filters",
// SIGGRAPH 1994). Pure functions; any thread.
#pragma once

#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// Where the halves of a pixel differ far more than those of the pixels around it, what one has too
/// much goes to that half of pixels with alike features, the nearest first, to darker ones in
/// proportion to their light. Sums over the picture stay, channel by channel and half by half.
/// Features are in units of their spread over the picture. Requires: light is not negative.
void spread_outliers(NoisyPicture& picture);

}  // namespace luxodus
