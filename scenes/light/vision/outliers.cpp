#include "scenes/light/vision/outliers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace luxodus {

namespace {

/// Reach of the neighbourhood that gives the usual difference of halves.
constexpr int reach_px = 2;
/// A pixel is an outlier if its halves differ by more than this many times the median.
constexpr float outlying = 5;
/// Largest distance of pixels that receive an outlier's light.
constexpr int farthest_px = 32;
/// Least such distance, so that some pixels are similar.
constexpr int nearest_px = 3;
/// The area grows until no pixel brightens by more than this share of their mean light.
constexpr double unseen_share = 0.05;
/// A feature difference of this size reduces the weight by a factor of exp(-1/2).
constexpr double alike = 0.5;

using Light = std::array<double, light_channels>;

struct Outlier {
  int x = 0, y = 0;
  size_t half = 0;
  Light excess{};
  double left = 1;  // share of the halves' difference that stays
};

struct Receiver {
  size_t pixel = 0;
  double weight = 0;
};

/// Finds outliers and the pixels that receive their light.
class Outliers {
 public:
  explicit Outliers(const NoisyPicture& picture) : picture_(picture) {
    for (size_t i = 0; i < picture.pixels(); ++i) differences_.push_back(light(0, i) - light(1, i));
  }

  /// The outlier at a pixel; `left` is 1 if it is none.
  Outlier at(int x, int y) {
    const size_t i = pixel(x, y);
    const float difference = std::abs(differences_[i]);
    Outlier out{x, y, differences_[i] > 0 ? size_t{0} : size_t{1}};
    const float most = outlying * median_around(x, y);
    if (!(difference > most)) return out;
    out.left = static_cast<double>(most / difference);
    for (size_t c = 0; c < light_channels; ++c) {
      const float more = light(out.half, i, c) - light(1 - out.half, i, c);
      out.excess[c] = (1 - out.left) * static_cast<double>(std::max(0.0f, more));
    }
    return out;
  }

  /// The receivers of its light; their weights sum to 1.
  const std::vector<Receiver>& receivers(const Outlier& outlier) {
    receivers_.clear();
    double weights = 0, light_of_all = 0;
    for (int far = 0; far <= farthest_px; ++far) {
      const size_t ring = receivers_.size();
      add_ring(outlier, far);
      for (size_t k = ring; k < receivers_.size(); ++k) {
        weights += receivers_[k].weight;
        light_of_all += receivers_[k].weight *
                        static_cast<double>(light(1 - outlier.half, receivers_[k].pixel));
      }
      if (far >= nearest_px && outlier.excess[1] <= unseen_share * light_of_all) break;
    }
    for (Receiver& receiver : receivers_) receiver.weight /= weights;
    return receivers_;
  }

  size_t pixel(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(picture_.width) + static_cast<size_t>(x);
  }

 private:
  /// [cd/m2]
  float light(size_t half, size_t pixel, size_t channel = 1) const {
    return picture_.half[half].light[light_channels * pixel + channel];
  }

  /// Median difference of the halves around a pixel, without its own [cd/m2].
  float median_around(int x, int y) {
    around_.clear();
    for (int v = std::max(0, y - reach_px); v <= std::min(picture_.height - 1, y + reach_px); ++v)
      for (int u = std::max(0, x - reach_px); u <= std::min(picture_.width - 1, x + reach_px); ++u)
        if (u != x || v != y) around_.push_back(std::abs(differences_[pixel(u, v)]));
    if (around_.empty()) return std::abs(differences_[pixel(x, y)]);
    const auto middle = around_.begin() + static_cast<std::ptrdiff_t>(around_.size() / 2);
    std::nth_element(around_.begin(), middle, around_.end());
    return *middle;
  }

  /// Pixels of the square ring at this distance.
  void add_ring(const Outlier& outlier, int far) {
    for (int y = outlier.y - far; y <= outlier.y + far; ++y) {
      if (y < 0 || y >= picture_.height) continue;
      const bool edge = std::abs(y - outlier.y) == far;
      for (int x = outlier.x - far; x <= outlier.x + far; x += edge || far == 0 ? 1 : 2 * far)
        if (x >= 0 && x < picture_.width)
          receivers_.push_back({pixel(x, y), likeness(outlier, pixel(x, y))});
    }
  }

  /// Weight by features, at most in proportion to the receiver's light in the other half, which is
  /// independent of the outlier.
  double likeness(const Outlier& outlier, size_t there) const {
    const size_t here = pixel(outlier.x, outlier.y), n = picture_.feature_count;
    double square = 0;
    for (size_t k = 0; k < n; ++k) {
      const auto difference =
          static_cast<double>(picture_.features[n * here + k] - picture_.features[n * there + k]);
      square += difference * difference;
    }
    const double by_features = std::exp(-square / (2 * alike * alike));
    const float light_here = light(1 - outlier.half, here);
    const float light_there = light(1 - outlier.half, there);
    if (!(light_there < light_here)) return by_features;
    return by_features * static_cast<double>(light_there / light_here);
  }

  const NoisyPicture& picture_;
  std::vector<float> differences_;  // of luminance, the first half less the second [cd/m2]
  std::vector<float> around_;
  std::vector<Receiver> receivers_;
};

}  // namespace

void spread_outliers(NoisyPicture& picture) {
  std::array<std::vector<float>, 2> moved;  // light of each half
  for (std::vector<float>& light : moved) light.resize(light_channels * picture.pixels());
  Outliers outliers(picture);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Outlier outlier = outliers.at(x, y);
      if (!(outlier.left < 1)) continue;
      std::vector<float>& light = moved[outlier.half];
      const auto move = [&](size_t pixel, double share) {
        for (size_t c = 0; c < light_channels; ++c)
          light[light_channels * pixel + c] += static_cast<float>(share * outlier.excess[c]);
      };
      const size_t here = outliers.pixel(x, y);
      move(here, -1);
      for (const Receiver& receiver : outliers.receivers(outlier))
        move(receiver.pixel, receiver.weight);
      // The error of the remaining light shrinks in proportion.
      for (size_t c = 0; c < 3; ++c)
        picture.half[outlier.half].variance[3 * here + c] *=
            static_cast<float>(outlier.left * outlier.left);
    }
  for (const size_t h : {size_t{0}, size_t{1}})
    for (size_t i = 0; i < moved[h].size(); ++i) picture.half[h].light[i] += moved[h][i];
}

}  // namespace luxodus
