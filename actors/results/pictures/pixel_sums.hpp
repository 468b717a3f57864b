// Integer sums over the paths of one pixel: the same bits for any order of paths, any number of
// threads or nodes. Plain values; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "scenes/light/tally/totals.hpp"
#include "scenes/light/transport/radiance_cache.hpp"
#include "scenes/light/vision/regression_filter.hpp"

namespace luxodus {

/// Features of a pixel: the normal's x, y, z, the nearness [1/m], the transmittance, and X, Y, Z of
/// the albedo, relative to white. Each is the mean over the pixel's paths.
inline constexpr size_t picture_features = 8;

/// Draws of random signs for bins of known light: each is a sample of its error.
inline constexpr size_t sign_draws = 8;

/// Light by channels of a picture: X, Y, Z, scotopic [cd/m2].
using ChannelLight = std::array<double, light_channels>;

/// The half of a pixel's paths that a path belongs to, by two bits of its number. Each half has two
/// of every four paths, and from 16 paths on both halves cover all quarters of the pixel evenly.
/// The parity of all bits would not do: it is the first digit of a Sobol' point's second dimension,
/// so the halves would be the upper and the lower half of the pixel.
constexpr size_t half_of(int path) {
  return static_cast<size_t>(std::popcount(static_cast<unsigned>(path) & 0b110u) % 2);
}

/// Weight of each half in a pixel's mean: its share of the paths that all pixels have. Paths added
/// to a half later do not change it: weights by the numbers of paths would be biased, because
/// chance decides these.
using HalfShares = std::array<double, 2>;
constexpr HalfShares shares_of_halves(int paths) {
  HalfShares shares{};
  for (int path = 0; path < paths; ++path) shares[half_of(path)] += 1.0 / paths;
  return shares;
}

/// Paths of a pixel by number: each half has those from `begin` up to, and excluding, its end.
using HalfEnds = std::array<int, 2>;
struct PathRange {
  int begin = 0;
  HalfEnds ends{};
};
constexpr PathRange all_paths(int begin, int end) {
  return {begin, {end, end}};
}

class PixelSums {
 public:
  /// Adds the result of a path: scattered and reflected light, light straight from emitters, the
  /// known light that its parts have ended in, and features.
  void add(int path, const ChannelLight& turned, const ChannelLight& straight,
           std::span<const CachedEnd> ends, const std::array<double, picture_features>& features) {
    const size_t half = half_of(path);
    for (size_t c = 0; c < light_channels; ++c) {
      sums_[turned_at(half, c)] += fixed(turned[c]);
      sums_[straight_at(half, c)] += fixed(straight[c]);
    }
    ++sums_[paths_at + half];
    for (size_t c = 0; c < 3; ++c) squares_[turned_square_at(half, c)] += square_of(turned[c]);
    squares_[luminance_square_at + half] += square_of(turned[1] + straight[1]);
    for (size_t k = 0; k < picture_features; ++k) sums_[features_at + k] += fixed(features[k]);
    for (size_t i = 0; i < ends.size(); ++i) add_known(ends, i);
  }

  /// Number of paths of a half.
  int paths(size_t half) const { return static_cast<int>(sums_[paths_at + half]); }
  int paths() const { return paths(0) + paths(1); }
  // Sums over the paths of a half: light [cd/m2], its squares [cd2/m4].
  double turned(size_t half, size_t channel) const { return sum(turned_at(half, channel)); }
  double straight(size_t half, size_t channel) const { return sum(straight_at(half, channel)); }
  double turned_squares(size_t half, size_t channel) const {
    return square(turned_square_at(half, channel));
  }
  /// Luminance of all light, squared.
  double luminance_squares(size_t half) const { return square(luminance_square_at + half); }
  /// All light [cd/m2].
  double mean_of_half(size_t half, size_t channel) const {
    return (turned(half, channel) + straight(half, channel)) / paths(half);
  }
  /// Mean of both halves [cd/m2].
  ChannelLight mean(const HalfShares& shares) const {
    ChannelLight light{};
    for (size_t c = 0; c < light_channels; ++c)
      for (const size_t h : {size_t{0}, size_t{1}})
        if (paths(h) > 0) light[c] += shares[h] * mean_of_half(h, c);
    return light;
  }
  /// Variance of the mean luminance [(cd/m2)2]. NaN with one path.
  double luminance_variance(const HalfShares& shares) const {
    const double all = paths();
    if (all < 2) return std::numeric_limits<double>::quiet_NaN();
    const double common = mean(shares)[luminance_channel];
    double variance = 0;
    for (const size_t h : {size_t{0}, size_t{1}}) {
      if (paths(h) == 0) continue;
      const double own = mean_of_half(h, luminance_channel);
      const double spread = luminance_squares(h) / paths(h) - 2 * common * own + common * common;
      variance += shares[h] * shares[h] * std::max(0.0, spread) / paths(h);
    }
    return variance * all / (all - 1);
  }
  // Sums over all paths.
  double feature(size_t k) const { return sum(features_at + k); }
  /// Sum of the luminance that paths have ended in [cd/m2].
  double known() const { return sum(known_at); }
  /// The part of the variance of the sum of known luminances that paths share. The part of each
  /// path alone is in the spread of the paths.
  double known_variance() const {
    double squared = 0;
    for (size_t k = 0; k < sign_draws; ++k)
      squared += sum(signed_at + k) * sum(signed_at + k) / sign_draws;
    return squared - square(known_square_at);
  }

  /// The sums as bins of totals, for transfer between nodes.
  static constexpr size_t bins =
      2 * light_channels + 2 * light_channels + 2 + 1 + sign_draws + picture_features;
  Total bin(size_t k) const { return {sums_[k], k < square_count ? squares_[k] : UInt128{0}}; }
  void add_bin(size_t k, const Total& total) {
    sums_[k] += total.sum;
    if (k < square_count) squares_[k] += total.squares;
  }

 private:
  // Indices among the sums.
  static constexpr size_t turned_at(size_t half, size_t c) { return half * light_channels + c; }
  static constexpr size_t straight_at(size_t half, size_t c) {
    return (2 + half) * light_channels + c;
  }
  static constexpr size_t paths_at = 4 * light_channels;
  static constexpr size_t known_at = paths_at + 2;
  static constexpr size_t signed_at = known_at + 1;
  static constexpr size_t features_at = signed_at + sign_draws;
  // Indices among the squares.
  static constexpr size_t turned_square_at(size_t half, size_t c) { return 3 * half + c; }
  static constexpr size_t luminance_square_at = 6;
  static constexpr size_t known_square_at = 8;
  static constexpr size_t square_count = 9;

  /// A sum is in units of 2^-28 cd/m2, a square in 2^-44. Nothing is brighter than 2^33 cd/m2, five
  /// times the sun, so a number has 61 bits, and 2^16 squares of 110 bits fit into 128.
  static constexpr double sum_scale = 0x1p28, root_scale = 0x1p22;
  static constexpr double brightest = 0x1p33;

  /// NaN becomes 0.
  static int64_t rounded(double value, double scale) {
    if (std::isnan(value)) return 0;
    return std::llrint(std::clamp(value, -brightest, brightest) * scale);
  }
  static Int128 fixed(double value) { return rounded(value, sum_scale); }
  static UInt128 square_of(double value) {
    const Int128 number = rounded(value, root_scale);
    return static_cast<UInt128>(number * number);
  }
  double sum(size_t at) const { return to_double(sums_[at]) / sum_scale; }
  double square(size_t at) const { return to_double(squares_[at]) / (root_scale * root_scale); }

  /// A random sign for each draw, one bit each: a hash of the bin's number (SplitMix64: G. L.
  /// Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
  static uint64_t signs_of(uint64_t bin) {
    uint64_t z = (bin + 1) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// Estimates shared errors by sign draws, since ends in the same bin have the same error. The
  /// path's own squares get that of the end, and its products with earlier ends in that bin.
  void add_known(std::span<const CachedEnd> ends, size_t i) {
    const CachedEnd& end = ends[i];
    const double error = end.luminance * end.error.relative;
    double before = 0;
    for (size_t k = 0; k < i; ++k)
      if (ends[k].error.bin == end.error.bin) before += ends[k].luminance * ends[k].error.relative;
    sums_[known_at] += fixed(end.luminance);
    squares_[known_square_at] += square_of(before + error) - square_of(before);
    const Int128 units = fixed(error);
    const uint64_t signs = signs_of(end.error.bin);
    for (size_t k = 0; k < sign_draws; ++k)
      sums_[signed_at + k] += (signs >> k & 1) != 0 ? units : -units;
  }

  std::array<Int128, bins> sums_{};
  std::array<UInt128, square_count> squares_{};
};

}  // namespace luxodus
