// Denoises traced pictures by nonlinearly weighted first-order regression on features (B. Bitterli
// et al., "Nonlinearly weighted first-order regression for denoising Monte Carlo renderings", EGSR
// 2016). In a window around a pixel, light is fitted as a linear function of noise-free features
// (normals, albedo, transmittance, emitted light). Pixels are weighted by the similarity of the
// light of their patches relative to the errors (non-local means, F. Rousselle et al., "Adaptive
// rendering with non-local means filtering", 2012). A picture comes as two halves of independent
// paths: one half gives the weights, the other the light, so that noise does not select itself;
// their difference gives the filter's own error. A pixel is also weighted by its number of paths.
// Light of single bright paths is spread first (outliers.hpp); pixels with few similar windows, as
// at edges, get a small window of their own; and the mean is preserved. For display only: verdicts
// use the traced values. Pure functions; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace luxodus {

/// X, Y, Z, scotopic.
inline constexpr size_t light_channels = 4, luminance_channel = 1;

/// Half of a picture's paths.
struct HalfPicture {
  std::vector<float> light;       // light_channels per pixel [cd/m2]
  std::vector<float> variance;    // of the means, 3 per pixel: of X, Y, Z [(cd/m2)2]
  std::vector<float> paths = {};  // number per pixel, in any unit; empty: equal for all

  double paths_of(size_t pixel) const {
    return paths.empty() ? 1 : static_cast<double>(paths[pixel]);
  }
};

struct NoisyPicture {
  int width = 0;
  int height = 0;
  std::array<HalfPicture, 2> half;
  /// Values per pixel that the light may be a function of: finite, in units in which 1 is a large
  /// difference.
  size_t feature_count = 0;
  std::vector<float> features;

  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
};

struct FilteredPicture {
  std::vector<float> light;             // light_channels per pixel [cd/m2], never below 0
  std::vector<float> standard_error_y;  // from the difference of the halves [cd/m2]
};

struct RegressionFilter {
  int window_px = 9;  // reach of a window
  int patch_px = 3;   // reach of the patches that are compared
  int stride_px = 3;  // between the windows' centres; each pixel is in several windows
  /// Whether pixels with few similar windows get a small window of their own.
  bool closely = true;
  /// Standard errors by which similar pixels may differ: a larger value smooths more.
  double tolerance = 0.5;
};

/// Does work(0) ... work(count - 1), in any order, on any threads.
using ShareWork = std::function<void(int64_t count, const std::function<void(int64_t)>& work)>;

/// The result is bitwise independent of the threads. Requires: consistent sizes, and 1 <= stride_px
/// <= window_px.
FilteredPicture filter_picture(NoisyPicture picture, const RegressionFilter& filter,
                               const ShareWork& share);

}  // namespace luxodus
