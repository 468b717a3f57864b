#include "actors/results/pictures/path_allocation.hpp"

#include <algorithm>
#include <cmath>

#include "actors/results/pictures/pixel_tracer.hpp"
#include "scenes/light/vision/error_left.hpp"

namespace luxodus {

namespace {

/// With fewer paths a half has less than six to estimate its error from.
constexpr int min_paths = 16;
/// Each half has two of every four paths, so both ends of a pixel are multiples of this.
constexpr int step = 4;
constexpr double max_times = 32;
/// A pixel darker than this share of the mean counts as that bright.
constexpr double dark = 0.05;
/// A pixel's error is taken as the mean over its neighbours up to this far: a pixel that missed
/// rare paths knows neither its error nor which pixels it resembles.
constexpr int shared_reach_px = 1;

/// The luminance of all pixels, from one half.
UncertainLight luminance_of(const std::vector<PixelSums>& pixels, size_t half) {
  UncertainLight out;
  for (const PixelSums& sums : pixels) {
    const double count = sums.paths(half);
    const double mean = sums.mean_of_half(half, luminance_channel);
    const double spread = std::max(0.0, sums.luminance_squares(half) / count - mean * mean);
    out.light.push_back(static_cast<float>(mean));
    out.variance.push_back(static_cast<float>(spread / (count - 1)));
  }
  return out;
}

/// For every pixel, the squared relative error that the filter will leave, estimated from one half.
std::vector<float> squared_errors(const UncertainLight& light, int width, int height,
                                  const ShareWork& share) {
  const std::vector<float> errors =
      error_left(light, width, height, RegressionFilter{}.tolerance, share);
  double mean = 0;
  for (const float value : light.light)
    mean += static_cast<double>(value) / static_cast<double>(errors.size());
  const auto darkest = static_cast<float>(dark * mean);
  std::vector<float> out(errors.size(), 0.0f);
  for (size_t i = 0; mean > 0 && i < errors.size(); ++i) {
    const float relative = errors[i] / std::max(light.light[i], darkest);
    out[i] = relative * relative;
  }
  std::vector<float> around = out, count(out.size(), 1.0f), scratch;
  const Rectangle all{0, 0, width, height};
  add_surroundings(around, all, shared_reach_px, scratch);
  add_surroundings(count, all, shared_reach_px, scratch);
  for (size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], around[i] / count[i]);
  return out;
}

/// The number of paths at which an error falls to the allowed one.
int end_of(float squared_error, double allowed, int paths) {
  const double times = std::clamp(static_cast<double>(squared_error) / allowed, 1.0, max_times);
  const auto steps = static_cast<int>(std::ceil(paths / step * times));
  return std::min(step * steps, limits::max_paths_per_pixel);
}

/// The least squared error that all pixels can reach.
double attainable(const std::vector<float>& squared_errors, int paths, int more) {
  const auto needed = [&](double allowed) {
    double sum = 0;
    for (const float error : squared_errors) sum += end_of(error, allowed, paths) - paths;
    return sum / static_cast<double>(squared_errors.size());
  };
  const double largest =
      static_cast<double>(*std::max_element(squared_errors.begin(), squared_errors.end()));
  constexpr int halvings = 40;
  double low = 1e-12 * largest, high = largest;
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(low * high);
    (needed(middle) > more ? low : high) = middle;
  }
  return high;
}

}  // namespace

int even_paths(int paths_per_pixel) {
  if (paths_per_pixel < min_paths) return paths_per_pixel;
  return paths_per_pixel * 3 / 4 / step * step;
}

std::vector<HalfEnds> allocate_paths(const std::vector<PixelSums>& pixels, int width, int height,
                                     int paths, int more, const ShareWork& share) {
  std::vector<HalfEnds> out(pixels.size(), {paths, paths});
  for (const size_t half : {size_t{0}, size_t{1}}) {
    const std::vector<float> errors =
        squared_errors(luminance_of(pixels, 1 - half), width, height, share);
    const double allowed = attainable(errors, paths, more);
    if (!(allowed > 0)) continue;  // there is no light, or no error
    for (size_t i = 0; i < out.size(); ++i) out[i][half] = end_of(errors[i], allowed, paths);
  }
  return out;
}

}  // namespace luxodus
