// Where the last paths of a picture go: to pixels of which the filter will leave much error, as at
// edges and in things that fill a pixel or two. The halves of a pixel's paths decide for each
// other, and keep their weights, so that chance does not choose itself: the mean of a pixel has no
// bias (samples that decide how many follow have one: D. Kirk and J. Arvo, "Unbiased sampling
// techniques for image synthesis", SIGGRAPH 1991). Pure functions; any thread.
#pragma once

#include <vector>

#include "actors/results/pictures/pixel_sums.hpp"
#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// How many of a pixel's paths, on average, all pixels have; the others are allocated. All, where
/// there are so few that halves would not know what to ask for.
int even_paths(int paths_per_pixel);

/// Where the paths of each pixel end when `more` paths have been added for each on average, or a
/// little less. No pixel gets more than 31 times what it has.
/// Requires: width * height pixels with `paths` paths each, a multiple of four.
std::vector<HalfEnds> allocate_paths(const std::vector<PixelSums>& pixels, int width, int height,
                                     int paths, int more, const ShareWork& share);

}  // namespace luxodus
