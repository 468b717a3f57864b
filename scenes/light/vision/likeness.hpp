// Similarity of pixels of a traced picture, for the filter (regression_filter.hpp) and for the
// prediction of its remaining error (error_left.hpp). Non-local means: F. Rousselle et al.,
// "Adaptive rendering with non-local means filtering", SIGGRAPH Asia 2012. Pure functions; any
// thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace luxodus {

/// Relative differences of light below this do not count, however small the errors.
inline constexpr float unseen_difference = 1e-3f;
/// Less similar pixels get weight 0 in a window: otherwise a dark pixel would take a share of a
/// bright window's light, which is small for the window but large for the pixel.
inline constexpr float min_alike = 0.05f;
/// Reach of a small window, and of the patches by which its pixels are compared.
inline constexpr int close_window_px = 4, close_patch_px = 1;

struct Rectangle {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // x1 and y1 are exclusive

  int width() const { return x1 - x0; }
  size_t pixels() const { return static_cast<size_t>(width()) * static_cast<size_t>(y1 - y0); }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y - y0) * static_cast<size_t>(width()) + static_cast<size_t>(x - x0);
  }
};

/// One channel of a picture.
struct UncertainLight {
  std::vector<float> light;     // [cd/m2]
  std::vector<float> variance;  // [(cd/m2)2]
};

/// Sums over the (2 reach + 1)^2 neighbourhood of every pixel, in place; beyond the edge nothing is
/// added.
void add_surroundings(std::vector<float>& values, const Rectangle& area, int reach,
                      std::vector<float>& scratch);

/// Corrects variances that are too small because no rare path has reached a pixel: raises them to
/// the mean of the neighbourhood, scaled down for a pixel darker than it, whose error is smaller.
/// `squares`: of light [(cd/m2)2].
void ask_surroundings(std::vector<float>& variance, const std::vector<float>& squares,
                      const Rectangle& area);

/// Squared difference of the light of two pixels, relative to their errors, less its expectation
/// from noise; `k2` is the square of the filter's tolerance. The expectation is that for two pixels
/// as noisy as the less noisy one: a dark, smooth pixel is not similar to a bright, noisy one,
/// whichever of them is the window's centre.
inline float unlikeness(float light, float variance, float other_light, float other_variance,
                        float k2) {
  const float difference = light - other_light;
  const float chance = 2 * std::min(variance, other_variance);
  const float level = unseen_difference * (light + other_light);
  const float scale = level * level + k2 * (variance + other_variance) + 1e-20f;
  return (difference * difference - chance) / scale;
}

/// The weight in a window for an unlikeness averaged over a patch and over channels.
inline float likeness_weight(float unlike) {
  const float weight = std::exp(-std::max(0.0f, unlike));
  return weight < min_alike ? 0.0f : weight;
}

/// Adds to each pixel of whole rows of a picture of that height its unlikeness to the pixel offset
/// by (dx, dy).
void add_unlikeness(const UncertainLight& of, int height, const Rectangle& rows, int dx, int dy,
                    float k2, std::vector<float>& to);
/// 1 where both pixels are in the picture, 0 elsewhere.
void mark_pairs(int height, const Rectangle& rows, int dx, int dy, std::vector<float>& pairs);

}  // namespace luxodus
