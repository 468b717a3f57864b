// Glare of the eye in pictures: the law of Ward Larson, Rushmeier and Piatko 1997, on test
// patterns.
#include "scenes/light/vision/eye_glare.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes/light/vision/tone.hpp"

using namespace luxodus;

namespace {

/// A dark picture with one lit pixel.
XyzPicture lone_light(int edge, int x, int y, float cd_m2) {
  XyzPicture p{edge, edge, std::vector<float>(3 * static_cast<size_t>(edge * edge)), {}};
  for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
    p.xyz[3 * static_cast<size_t>(y * edge + x) + c] = cd_m2;
  return p;
}

double luminance_at(const XyzPicture& p, int x, int y) {
  return static_cast<double>(p.xyz[3 * static_cast<size_t>(y * p.width + x) + 1]);
}

/// Direction of a pixel, with pixels of one degree in the middle.
std::array<double, 3> line_of_sight(int edge, int x, int y) {
  const double pixel = std::numbers::pi / 180;
  const std::array<double, 3> d{(x + 0.5 - 0.5 * edge) * pixel, (y + 0.5 - 0.5 * edge) * pixel, 1};
  const double length = std::hypot(d[0], d[1], d[2]);
  return {d[0] / length, d[1] / length, d[2] / length};
}

}  // namespace

TEST_CASE("a uniform field is not veiled, in any of its channels", "[vision][glare]") {
  for (const double degrees : {0.02, 0.3, 1.0}) {
    XyzPicture p{160, 90, {}, {}};
    for (size_t i = 0; i < p.pixels(); ++i) {
      p.xyz.insert(p.xyz.end(), {3.0f, 10.0f, 0.5f});
      p.scotopic.push_back(22.0f);
    }
    const XyzPicture veiled = with_eye_glare(p, degrees);
    for (size_t i = 0; i < p.pixels(); ++i) {
      for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
        CHECK(veiled.xyz[3 * i + c] == Approx(p.xyz[3 * i + c]).epsilon(1e-4));
      CHECK(veiled.scotopic[i] == Approx(22).epsilon(1e-4));
    }
  }
}

TEST_CASE("a light veils each place by the cosine over the squared angle", "[vision][glare]") {
  constexpr int edge = 40;
  constexpr int at_x = 12, at_y = 25;
  const XyzPicture veiled = with_eye_glare(lone_light(edge, at_x, at_y, 5000), 1);
  CHECK(luminance_at(veiled, at_x, at_y) == Approx((1 - veil_share) * 5000));
  const auto weight = [&](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return cosine / std::pow(std::acos(std::min(1.0, cosine)), 2);
  };
  for (const auto& [x, y] : {std::pair{13, 25}, {15, 20}, {30, 25}, {0, 0}, {39, 39}}) {
    const auto here = line_of_sight(edge, x, y);
    double all = 0, of_light = 0;
    for (int row = 0; row < edge; ++row)
      for (int column = 0; column < edge; ++column) {
        if (row == y && column == x) continue;
        const auto there = line_of_sight(edge, column, row);
        // Pixels of a flat picture subtend less off its middle.
        const double w = weight(here, there) * std::pow(there[2], 3);
        all += w;
        if (column == at_x && row == at_y) of_light = w;
      }
    INFO("at " << x << ", " << y);
    CHECK(luminance_at(veiled, x, y) == Approx(veil_share * 5000 * of_light / all).epsilon(0.01));
  }
}

TEST_CASE("the veil falls with the angle and grows with the light", "[vision][glare]") {
  const XyzPicture once = with_eye_glare(lone_light(48, 24, 24, 1000), 1);
  const XyzPicture thrice = with_eye_glare(lone_light(48, 24, 24, 3000), 1);
  double before = luminance_at(once, 25, 24);
  // Near an edge of the picture fewer places share in the mean, so the veil rises there.
  for (int x = 26; x < 42; ++x) {
    CHECK(luminance_at(once, x, 24) < before);
    before = luminance_at(once, x, 24);
    CHECK(luminance_at(thrice, x, 24) == Approx(3 * before).epsilon(1e-5));
  }
  // About four times as much at half the distance, except for the effect of the picture's edges.
  CHECK(luminance_at(once, 28, 24) / luminance_at(once, 32, 24) == Approx(4).margin(0.6));
}

TEST_CASE("a view with more degrees than separate cells keeps a uniform field and its veil",
          "[vision][glare]") {
  XyzPicture wide{240, 240, std::vector<float>(3 * 240 * 240, 7.0f), {}};
  const XyzPicture even = with_eye_glare(wide, 0.5);
  for (size_t i = 0; i < wide.pixels(); i += 97)
    CHECK(even.xyz[3 * i + 1] == Approx(7).epsilon(1e-4));
  const auto far_veil = [](double degrees, int edge) {
    XyzPicture p{edge, edge, std::vector<float>(3 * static_cast<size_t>(edge * edge)), {}};
    // A tenth of the view is lit, at the left.
    for (int y = 0; y < edge; ++y)
      for (int x = 0; x < edge / 10; ++x)
        for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
          p.xyz[3 * static_cast<size_t>(y * edge + x) + c] = 100;
    return luminance_at(with_eye_glare(p, degrees), edge - edge / 5, edge / 2);
  };
  // One view in 100 x 100 pixels of one degree, which exceed the cells' limit so that cells are of
  // two degrees; and in 50 x 50 pixels of two degrees, whose centres lie half a degree farther.
  const double coarse = far_veil(1, 100);
  CHECK(coarse == Approx(far_veil(2, 50)).epsilon(0.05));
  // The mean excludes light within a cell, so far light gets a larger share with cells of two
  // degrees: ln(50 / 1) / ln(50 / 2) = 1.2, in a field of some 50 degrees around.
  CHECK(coarse / far_veil(100.0 / 90, 90) == Approx(1.2).margin(0.1));
}

TEST_CASE("an invalid pixel veils nothing and stays as it is", "[vision][glare]") {
  XyzPicture p{32, 32, std::vector<float>(3 * 32 * 32, 1.0f), {}};
  p.xyz[3 * 40 + 1] = std::nanf("");
  p.xyz[3 * 41] = INFINITY;
  const XyzPicture veiled = with_eye_glare(p, 1);
  CHECK(std::isnan(veiled.xyz[3 * 40 + 1]));
  CHECK(std::isinf(veiled.xyz[3 * 41]));
  for (size_t i = 0; i < p.pixels(); ++i)
    if (i != 40 && i != 41) CHECK(std::isfinite(veiled.xyz[3 * i + 1]));
  CHECK(with_eye_glare(XyzPicture{}, 1).xyz.empty());
}

TEST_CASE("a lamp beside a dim sign reduces its contrast in a human view", "[vision][glare]") {
  // Bars of 0.5 and 1.5 cd/m2, three degrees wide; above them a lamp of 20 000 cd/m2.
  const auto bars = [](float lamp) {
    XyzPicture p{48, 48, {}, {}};
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) {
        const float bar = x / 6 % 2 == 0 ? 0.5f : 1.5f;
        const float l = y < 6 && x >= 20 && x < 28 ? lamp : bar;
        p.xyz.insert(p.xyz.end(), {0.95f * l, l, 1.09f * l});
      }
    return p;
  };
  HumanTone eye;
  eye.degrees_per_pixel = 0.5;
  HumanTone without = eye;
  without.glare = false;
  const auto contrast = [](const SrgbPicture& p, int y) {
    const auto level = [&](int x) {
      return static_cast<double>(p.rgb[3 * static_cast<size_t>(y * 48 + x) + 1]);
    };
    return (level(21) - level(27)) / (level(21) + level(27));
  };
  const XyzPicture dazzling = bars(20'000), calm = bars(1);
  const SrgbPicture veiled = tone_human(dazzling, eye), clear = tone_human(dazzling, without);
  INFO("near the lamp " << contrast(veiled, 9) << " and " << contrast(clear, 9) << ", far from it "
                        << contrast(veiled, 44));
  CHECK(contrast(veiled, 9) < 0.5 * contrast(clear, 9));
  CHECK(contrast(veiled, 9) < contrast(veiled, 44));
  CHECK(contrast(tone_human(calm, eye), 9) > 0.8 * contrast(tone_human(calm, without), 9));
}
