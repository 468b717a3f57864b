// Outliers (fireflies) in a traced picture: spreads the light of single bright paths over similar
// pixels and preserves the sum (H. E. Rushmeier and G. J. Ward, "Energy preserving non-linear
// filters", SIGGRAPH 1994). Pure functions; any thread.
#pragma once

#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// If the halves of a pixel differ far more than those of the pixels around it, the excess of the
/// brighter half is moved to that half of pixels with similar features, nearest first, and to
/// darker ones in proportion to their light. Sums over the picture are preserved, channel by
/// channel and half by half. Features are in units of their spread over the picture. Requires:
/// light is not negative.
void spread_outliers(NoisyPicture& picture);

}  // namespace luxodus
