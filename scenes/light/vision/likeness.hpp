// How alike pixels of a traced picture are, for the filter (regression_filter.hpp) and for whoever
// asks what it will leave (error_left.hpp). Non-local means: F. Rousselle et al., "Adaptive
// rendering with non-local means filtering", SIGGRAPH Asia 2012. Pure functions; any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace luxodus {

/// Differences of light below this share are no differences, however small the errors.
inline constexpr float unseen_difference = 1e-3f;
/// Pixels that are less alike do not count in a window: one that is dark would take a share of a
/// bright window's light, however small, that is much for it.
inline constexpr float least_alike = 0.05f;
/// A small window reaches as far, and so do the surroundings by which its pixels are compared.
inline constexpr int close_window_px = 4, close_patch_px = 1;

struct Rectangle {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // without x1 and y1

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

/// Sums over the (2 reach + 1)^2 surroundings of every pixel, in place; what lies beyond the edge
/// is left out.
void add_surroundings(std::vector<float>& values, const Rectangle& area, int reach,
                      std::vector<float>& scratch);

/// A pixel that has missed all rare paths does not know its error; its surroundings do, but for one
/// that is darker, whose error is smaller. `squares`: of light [(cd/m2)2].
void ask_surroundings(std::vector<float>& variance, const std::vector<float>& squares,
                      const Rectangle& area);

/// How unlike the light of two pixels is, in units of what their errors explain, with what chance
/// brings taken off; `k2` is the square of the filter's tolerance. As much as chance brings where
/// both are as noisy as the less noisy: what is dark and even is not like what is bright and noisy,
/// whichever of them the window is around.
inline float unlikeness(float light, float variance, float other_light, float other_variance,
                        float k2) {
  const float difference = light - other_light;
  const float chance = 2 * std::min(variance, other_variance);
  const float level = unseen_difference * (light + other_light);
  const float scale = level * level + k2 * (variance + other_variance) + 1e-20f;
  return (difference * difference - chance) / scale;
}

/// The weight in a window of an unlikeness: a mean over surroundings, and over channels.
inline float likeness_weight(float unlike) {
  const float weight = std::exp(-std::max(0.0f, unlike));
  return weight < least_alike ? 0.0f : weight;
}

/// Adds to each pixel of whole rows of a picture of that height how unlike the pixel beside it by
/// (dx, dy) is.
void add_unlikeness(const UncertainLight& of, int height, const Rectangle& rows, int dx, int dy,
                    float k2, std::vector<float>& to);
/// 1 where both pixels are in the picture, 0 elsewhere.
void mark_pairs(int height, const Rectangle& rows, int dx, int dy, std::vector<float>& pairs);

}  // namespace luxodus
