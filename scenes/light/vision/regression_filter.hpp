// Removes noise of traced pictures: nonlinearly weighted first-order regression on features (B.
// Bitterli et al., "Nonlinearly weighted first-order regression for denoising Monte Carlo
// renderings", EGSR 2016). In a window around a pixel, light is fitted as a linear function of what
// is known of each pixel without chance (features: normals, albedo, transmittance, emitted light).
// Pixels count by how alike their surroundings are in light, within the errors (non-local means, F.
// Rousselle et al., "Adaptive rendering with non-local means filtering", 2012). A picture comes as
// two halves of independent paths: one half says which pixels are alike, the other gives the light,
// so that chance does not choose itself; and their difference is the filter's own error. A pixel
// counts as much as it has paths. Light of single bright paths is spread first (outliers.hpp);
// pixels that few windows are like, as at edges, have a small one of their own; and the mean is
// kept. For pictures to look at: verdicts come from traced numbers. Pure functions; any thread.
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
  std::vector<float> paths = {};  // of each pixel, in any unit; none: all have as many

  double paths_of(size_t pixel) const {
    return paths.empty() ? 1 : static_cast<double>(paths[pixel]);
  }
};

struct NoisyPicture {
  int width = 0;
  int height = 0;
  std::array<HalfPicture, 2> half;
  /// Values per pixel that the light may be a function of: finite, in units of which 1 is a large
  /// difference.
  size_t feature_count = 0;
  std::vector<float> features;

  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
};

struct FilteredPicture {
  std::vector<float> light;             // light_channels per pixel [cd/m2], never below 0
  std::vector<float> standard_error_y;  // by the difference of the halves [cd/m2]
};

struct RegressionFilter {
  int window_px = 9;  // pixels as far as this are asked
  int patch_px = 3;   // surroundings that are compared reach as far as this
  int stride_px = 3;  // between the windows' centres; each pixel is in several windows
  /// Whether pixels that few windows are like have a small one of their own.
  bool closely = true;
  /// Standard errors by which alike pixels differ: more smooths more.
  double tolerance = 0.5;
};

/// Does work(0) ... work(count - 1), in any order, on any threads.
using ShareWork = std::function<void(int64_t count, const std::function<void(int64_t)>& work)>;

/// The same for any threads, bit for bit. Requires: sizes that fit together, and 1 <= stride_px <=
/// window_px.
FilteredPicture filter_picture(NoisyPicture picture, const RegressionFilter& filter,
                               const ShareWork& share);

}  // namespace luxodus
