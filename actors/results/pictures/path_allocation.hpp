// Allocates the last paths of a picture to pixels in which the filter will leave much error, as at
// edges and in details of a pixel or two. The two halves of a pixel's paths decide for each other,
// and keep their weights, so that no sample influences its own number: the mean of a pixel has no
// bias (samples that decide how many follow have one: D. Kirk and J. Arvo, "Unbiased sampling
// techniques for image synthesis", SIGGRAPH 1991). Pure functions; any thread.
#pragma once

#include <vector>

#include "actors/results/pictures/pixel_sums.hpp"
#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// How many of a pixel's paths, on average, are the same for all pixels; the others are allocated.
/// All, if the halves would have too few to decide.
int even_paths(int paths_per_pixel);

/// The ends of each pixel's paths when `more` paths, or slightly fewer, have been added per pixel
/// on average. No pixel gets more than 31 times its present number.
/// Requires: width * height pixels with `paths` paths each, a multiple of four.
std::vector<HalfEnds> allocate_paths(const std::vector<PixelSums>& pixels, int width, int height,
                                     int paths, int more, const ShareWork& share);

}  // namespace luxodus
