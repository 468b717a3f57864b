// The filter removes noise and nothing else.
#include "scenes/light/vision/regression_filter.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

using namespace luxodus;

namespace {

using LightAt = std::function<double(int x, int y)>;

void in_order(int64_t count, const std::function<void(int64_t)>& work) {
  for (int64_t i = 0; i < count; ++i) work(i);
}

/// Light with independent `noise` [cd/m2] in each half, and one feature.
NoisyPicture noisy_picture(int width, int height, const LightAt& light, const LightAt& feature,
                           double noise) {
  NoisyPicture out;
  out.width = width;
  out.height = height;
  out.feature_count = 1;
  std::mt19937 random(7);
  std::normal_distribution<double> chance(0, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out.features.push_back(static_cast<float>(feature(x, y)));
  for (HalfPicture& half : out.half)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        for (size_t c = 0; c < light_channels; ++c)
          half.light.push_back(static_cast<float>(light(x, y) + noise * chance(random)));
        half.variance.insert(half.variance.end(), 3, static_cast<float>(noise * noise));
      }
  return out;
}

/// Adds noise in proportion to light, of share `relative`.
void make_noisy(NoisyPicture& picture, double relative) {
  std::mt19937 random(5);
  std::normal_distribution<double> chance(0, relative);
  const auto squared = static_cast<float>(relative * relative);
  for (HalfPicture& half : picture.half)
    for (size_t i = 0; i < picture.pixels(); ++i) {
      const double factor = std::max(0.0, 1 + chance(random));
      for (size_t c = 0; c < light_channels; ++c)
        half.light[light_channels * i + c] *= static_cast<float>(factor);
      for (size_t c = 0; c < 3; ++c) {
        const float light = half.light[light_channels * i + c];
        half.variance[3 * i + c] = squared * light * light;
      }
    }
}

double luminance(const FilteredPicture& picture, size_t pixel) {
  return static_cast<double>(picture.light[light_channels * pixel + 1]);
}

/// Root mean square of the remaining noise [cd/m2].
double rms_error(const FilteredPicture& picture, const NoisyPicture& of, const LightAt& light) {
  double squares = 0;
  for (int y = 0; y < of.height; ++y)
    for (int x = 0; x < of.width; ++x) {
      const auto pixel = static_cast<size_t>(y * of.width + x);
      squares += std::pow(luminance(picture, pixel) - light(x, y), 2);
    }
  return std::sqrt(squares / static_cast<double>(of.pixels()));
}

constexpr double no_feature(int, int) {
  return 1;
}

}  // namespace

TEST_CASE("noise is removed from uniform light, which keeps its mean", "[filter]") {
  const LightAt even = [](int, int) { return 10.0; };
  const NoisyPicture noisy = noisy_picture(64, 48, even, no_feature, 4);
  const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
  // The mean of both halves has noise of 4 / sqrt(2).
  CHECK(rms_error(filtered, noisy, even) < 0.25 * 4 / std::sqrt(2));
  double raw = 0, mean = 0;
  for (size_t i = 0; i < noisy.pixels(); ++i) {
    raw += static_cast<double>(noisy.half[0].light[light_channels * i + 1] +
                               noisy.half[1].light[light_channels * i + 1]) /
           2;
    mean += luminance(filtered, i);
  }
  CHECK(mean / raw == Approx(1).epsilon(1e-5));
}

TEST_CASE("the filter estimates the size of its own error", "[filter]") {
  const LightAt even = [](int, int) { return 10.0; };
  const NoisyPicture noisy = noisy_picture(96, 64, even, no_feature, 3);
  const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
  double said = 0;
  for (const float error : filtered.standard_error_y) said += std::pow(error, 2.0);
  said = std::sqrt(said / static_cast<double>(noisy.pixels()));
  const double is = rms_error(filtered, noisy, even);
  CHECK(said > 0.5 * is);
  CHECK(said < 2 * is);
}

TEST_CASE("the filter weights a pixel by its number of paths", "[filter]") {
  const LightAt even = [](int, int) { return 10.0; };
  const NoisyPicture noisy = noisy_picture(64, 48, even, no_feature, 4);
  NoisyPicture known = noisy;  // sixteen times the paths in every second column
  for (HalfPicture& half : known.half)
    for (size_t i = 0; i < known.pixels(); ++i) {
      const bool often = i % 2 == 0;
      half.paths.push_back(often ? 16 : 1);
      for (size_t c = 0; often && c < light_channels; ++c) {
        float& light = half.light[light_channels * i + c];
        light = 10 + (light - 10) / 4;
        if (c < 3) half.variance[3 * i + c] /= 16;
      }
    }
  NoisyPicture alike = known;
  for (HalfPicture& half : alike.half) half.paths.clear();
  const double is = rms_error(filter_picture(known, {}, in_order), noisy, even);
  CHECK(is < 0.8 * rms_error(filter_picture(alike, {}, in_order), noisy, even));
}

TEST_CASE("an edge in a feature stays sharp under noise", "[filter]") {
  const LightAt albedo = [](int x, int) { return x < 32 ? 0.2 : 0.8; };
  const LightAt light = [&](int x, int y) { return 50 * albedo(x, y); };
  const NoisyPicture noisy = noisy_picture(64, 48, light, albedo, 8);
  const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
  double dark = 0, bright = 0;
  for (int y = 0; y < 48; ++y) {
    dark += luminance(filtered, static_cast<size_t>(y * 64 + 31)) / 48;
    bright += luminance(filtered, static_cast<size_t>(y * 64 + 32)) / 48;
  }
  CHECK(dark == Approx(10).margin(1.5));
  CHECK(bright == Approx(40).margin(1.5));
}

TEST_CASE("pixels on an edge lose their noise as others do", "[filter]") {
  // Every pixel of a slanted edge has a share of its own: few large patches are similar to its
  // patch.
  const double slant = GENERATE(0.05, 0.3, 1.3);
  CAPTURE(slant);
  const LightAt share = [&](int x, int y) {
    return std::clamp(slant * (y - 24) - x + 32, 0.0, 1.0);
  };
  const LightAt light = [&](int x, int y) { return 20 + 80 * share(x, y); };
  constexpr double noise = 0.3;
  NoisyPicture noisy = noisy_picture(64, 48, light, share, 0);
  make_noisy(noisy, noise);
  const auto error_of_edge = [&](const RegressionFilter& filter) {
    const FilteredPicture filtered = filter_picture(noisy, filter, in_order);
    double squares = 0, count = 0;
    for (int y = 6; y < 42; ++y)
      for (int x = 6; x < 58; ++x) {
        if (share(x, y) <= 0 || share(x, y) >= 1) continue;
        const double filtered_light = luminance(filtered, static_cast<size_t>(y * 64 + x));
        squares += std::pow(filtered_light / light(x, y) - 1, 2);
        ++count;
      }
    REQUIRE(count > 20);
    return std::sqrt(squares / count);
  };
  const double closely = error_of_edge({});
  CHECK(closely < 0.6 * noise / std::sqrt(2));
  // The almost vertical edge has the fewest similar pixels.
  if (slant < 0.1) CHECK(error_of_edge({.closely = false}) > 1.2 * closely);
}

TEST_CASE("a legend resolved in the light is kept, though no feature shows it", "[filter]") {
  const LightAt strokes = [](int x, int y) {
    const bool legend = x > 20 && x < 44 && y > 16 && y < 32;
    return legend && (x / 2) % 2 == 0 ? 40.0 : 10.0;
  };
  SECTION("without noise, to a hundredth") {
    const NoisyPicture sharp = noisy_picture(64, 48, strokes, no_feature, 0);
    CHECK(rms_error(filter_picture(sharp, {}, in_order), sharp, strokes) < 0.1);
  }
  SECTION("with noise of a tenth of its contrast, to most of it") {
    const NoisyPicture noisy = noisy_picture(64, 48, strokes, no_feature, 3);
    const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
    double bright = 0, dark = 0, count = 0;
    for (int y = 20; y < 28; ++y)
      for (int x = 24; x < 40; x += 4, ++count) {
        bright += luminance(filtered, static_cast<size_t>(y * 64 + x));
        dark += luminance(filtered, static_cast<size_t>(y * 64 + x + 2));
      }
    CHECK((bright - dark) / count > 0.8 * 30);
  }
}

TEST_CASE("a single bright path leaves no visible spot", "[filter]") {
  NoisyPicture noisy = noisy_picture(
      96, 64, [](int, int) { return 10.0; }, no_feature, 1);
  const size_t bright = 32 * 96 + 48;
  for (size_t c = 0; c < light_channels; ++c)
    noisy.half[0].light[light_channels * bright + c] = 500;
  noisy.half[0].variance[3 * bright + 1] = 250'000;
  const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
  for (size_t i = 0; i < noisy.pixels(); ++i) CHECK(luminance(filtered, i) < 12);
}

TEST_CASE("a dark spot stays dark next to bright noise", "[filter]") {
  const LightAt spot = [](int x, int y) {
    return x >= 40 && x < 50 && y >= 25 && y < 35 ? 0.1 : 10.0;
  };
  NoisyPicture noisy = noisy_picture(96, 64, spot, no_feature, 0);
  make_noisy(noisy, 0.3);
  const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
  for (int y = 25; y < 35; ++y)
    for (int x = 40; x < 50; ++x) CHECK(luminance(filtered, static_cast<size_t>(96 * y + x)) < 0.2);
}

TEST_CASE("a filtered picture has the same bits in any order of work", "[filter]") {
  const LightAt slope = [](int x, int y) { return 1.0 + x + 0.5 * y; };
  const NoisyPicture noisy = noisy_picture(50, 110, slope, slope, 5);
  const FilteredPicture forward = filter_picture(noisy, {}, in_order);
  const FilteredPicture backward =
      filter_picture(noisy, {}, [](int64_t count, const std::function<void(int64_t)>& work) {
        while (count-- > 0) work(count);
      });
  CHECK(forward.light == backward.light);
  CHECK(forward.standard_error_y == backward.standard_error_y);
}

TEST_CASE("pictures smaller than a window are filtered, and light is never negative", "[filter]") {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {7, 1}, {5, 4}}) {
    CAPTURE(width, height);
    const NoisyPicture noisy = noisy_picture(
        width, height, [](int, int) { return 0.5; }, no_feature, 2);
    const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
    REQUIRE(filtered.light.size() == light_channels * noisy.pixels());
    for (const float light : filtered.light) {
      CHECK(std::isfinite(light));
      CHECK(light >= 0);
    }
  }
}

TEST_CASE("light with all channels everywhere keeps them in every pixel", "[filter]") {
  // Rare bright paths of different colours, and features that noise seems to follow: fits become
  // negative in some channels of some pixels, and a pixel with one channel has a glaring colour.
  NoisyPicture noisy = noisy_picture(
      60, 40, [](int, int) { return 0.0; }, [](int x, int y) { return (x * x + 3 * y) % 7 / 7.0; },
      0);
  std::mt19937 random(3);
  std::exponential_distribution<double> chance(1);
  for (HalfPicture& half : noisy.half)
    for (size_t i = 0; i < half.light.size(); ++i) {
      const double light = 1e-3 + std::pow(chance(random), 5);
      half.light[i] = static_cast<float>(light);
      if (i % light_channels < 3)
        half.variance[i / light_channels * 3 + i % light_channels] =
            static_cast<float>(light * light);
    }
  const FilteredPicture filtered = filter_picture(noisy, {}, in_order);
  for (size_t i = 0; i < noisy.pixels(); ++i) {
    if (luminance(filtered, i) == 0) continue;
    for (size_t c = 0; c < light_channels; ++c) CHECK(filtered.light[light_channels * i + c] > 0);
  }
}

TEST_CASE("darkness stays dark", "[filter]") {
  const NoisyPicture dark = noisy_picture(
      40, 30, [](int, int) { return 0.0; }, no_feature, 0);
  const FilteredPicture filtered = filter_picture(dark, {}, in_order);
  for (const float light : filtered.light) CHECK(light == 0);
  for (const float error : filtered.standard_error_y) CHECK(error == 0);
}
