// Light of single bright paths is moved to similar pixels, and its sum is preserved.
#include "scenes/light/vision/outliers.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace luxodus;

namespace {

constexpr int across = 80, down = 60;

size_t pixel(int x, int y) {
  return static_cast<size_t>(y * across + x);
}

/// Light of 1 whose halves differ by a tenth; the feature is 0 left of the middle and 3 right of
/// it, where the light is `right`.
NoisyPicture two_sides(float right) {
  NoisyPicture out;
  out.width = across;
  out.height = down;
  out.feature_count = 1;
  for (HalfPicture& half : out.half) half.variance.assign(3 * out.pixels(), 0.01f);
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) {
      const bool is_right = x >= across / 2;
      out.features.push_back(is_right ? 3.0f : 0.0f);
      for (const size_t h : {size_t{0}, size_t{1}}) {
        const float chance = (x + y + static_cast<int>(h)) % 2 == 0 ? 0.05f : -0.05f;
        out.half[h].light.insert(out.half[h].light.end(), light_channels,
                                 is_right ? right * (1 + chance) : 1 + chance);
      }
    }
  return out;
}

double sum(const NoisyPicture& picture, size_t half, size_t channel) {
  double out = 0;
  for (size_t i = 0; i < picture.pixels(); ++i)
    out += static_cast<double>(picture.half[half].light[light_channels * i + channel]);
  return out;
}

float luminance(const NoisyPicture& picture, size_t half, size_t i) {
  return picture.half[half].light[light_channels * i + 1];
}

}  // namespace

TEST_CASE("a single bright path is spread over similar pixels, and its light is preserved",
          "[filter]") {
  NoisyPicture picture = two_sides(1);
  const size_t bright = pixel(30, 30);
  const float colour[] = {40, 60, 20, 5};
  for (size_t c = 0; c < light_channels; ++c)
    picture.half[1].light[light_channels * bright + c] = colour[c];
  picture.half[1].variance[3 * bright + 1] = 3600;
  const NoisyPicture before = picture;
  spread_outliers(picture);

  CHECK(luminance(picture, 1, bright) < 2);
  CHECK(picture.half[1].variance[3 * bright + 1] < 1);
  for (size_t c = 0; c < light_channels; ++c)
    CHECK(sum(picture, 1, c) == Approx(sum(before, 1, c)).epsilon(1e-5));
  CHECK(picture.half[0].light == before.half[0].light);
  // A little more next to it; as much at another similar place; nothing across the edge.
  CHECK(luminance(picture, 1, pixel(32, 30)) > luminance(before, 1, pixel(32, 30)));
  CHECK(luminance(picture, 1, pixel(32, 30)) < 1.1f * luminance(before, 1, pixel(32, 30)));
  CHECK(luminance(picture, 1, pixel(45, 30)) == luminance(before, 1, pixel(45, 30)));
}

TEST_CASE("darker pixels receive less of a bright path, in proportion to their light", "[filter]") {
  NoisyPicture picture = two_sides(0.01f);
  std::fill(picture.features.begin(), picture.features.end(), 0.0f);
  picture.half[0].light[light_channels * pixel(38, 20) + 1] = 60;
  const NoisyPicture before = picture;
  spread_outliers(picture);
  const auto gain = [&](size_t i) { return luminance(picture, 0, i) / luminance(before, 0, i); };
  CHECK(gain(pixel(36, 20)) > 1.02f);
  CHECK(gain(pixel(42, 20)) > 1.02f);
  CHECK(gain(pixel(42, 20)) < 1.1f);
}

TEST_CASE("a value in both halves is not an outlier, nor is ordinary noise", "[filter]") {
  NoisyPicture picture = two_sides(1);
  for (HalfPicture& half : picture.half) half.light[light_channels * pixel(10, 10) + 1] = 500;
  // The halves differ four times as much as those around them.
  picture.half[0].light[light_channels * pixel(60, 10) + 1] = 1.2f;
  picture.half[1].light[light_channels * pixel(60, 10) + 1] = 0.8f;
  const NoisyPicture before = picture;
  spread_outliers(picture);
  CHECK(picture.half[0].light == before.half[0].light);
  CHECK(picture.half[1].light == before.half[1].light);
}

TEST_CASE("many bright paths, and pictures of one pixel, stay finite and not negative",
          "[filter]") {
  NoisyPicture wild = two_sides(1);
  for (size_t h : {size_t{0}, size_t{1}})
    for (size_t i = h; i < wild.half[h].light.size(); i += 11)
      wild.half[h].light[i] = std::ldexp(1.0f, static_cast<int>(i % 30));
  const NoisyPicture before = wild;
  spread_outliers(wild);
  for (const size_t h : {size_t{0}, size_t{1}}) {
    for (const float light : wild.half[h].light) {
      REQUIRE(std::isfinite(light));
      REQUIRE(light >= 0);
    }
    for (size_t c = 0; c < light_channels; ++c)
      CHECK(sum(wild, h, c) == Approx(sum(before, h, c)).epsilon(1e-4));
  }

  NoisyPicture single;
  single.width = single.height = 1;
  single.half[0] = {{9, 9, 9, 9}, {1, 1, 1}};
  single.half[1] = {{1, 1, 1, 1}, {1, 1, 1}};
  spread_outliers(single);
  CHECK(single.half[0].light == std::vector<float>{9, 9, 9, 9});
}
