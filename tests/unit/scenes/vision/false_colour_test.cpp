#include "scenes/vision/false_colour.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "scenes/optics/chromaticity.hpp"
#include "tests/unit/scenes/vision/linear_of_srgb.hpp"

using namespace luxodus;

namespace {

// CIELAB of an sRGB colour, written apart from the map's own arithmetic.
std::array<double, 3> lab(Rgb8 c) {
  const Xyz xyz =
      xyz_from_linear_srgb({test::linear_of_srgb_byte(c.r), test::linear_of_srgb_byte(c.g),
                            test::linear_of_srgb_byte(c.b)});
  const auto f = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const double fx = f(xyz[0] / d65_white[0]), fy = f(xyz[1]), fz = f(xyz[2] / d65_white[2]);
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

double difference(Rgb8 p, Rgb8 q) {
  const auto a = lab(p), b = lab(q);
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

std::string texts(const std::vector<Tick>& ticks) {
  std::string out;
  for (const Tick& t : ticks) out += (out.empty() ? "" : " ") + t.text;
  return out;
}

}  // namespace

TEST_CASE("sRGB bytes survive the way through linear light", "[vision][picture]") {
  for (int i = 0; i < 256; ++i)
    CHECK(srgb_byte(test::linear_of_srgb_byte(static_cast<uint8_t>(i))) == i);
  CHECK(srgb_byte(-1) == 0);
  CHECK(srgb_byte(2) == 255);
  CHECK(srgb_byte(std::nan("")) == 0);
  CHECK(srgb_byte(0.2140) == 127);  // half grey
}

TEST_CASE("the map grows lighter from end to end", "[vision][false_colour]") {
  double before = lab(map_colour(0))[0];
  CHECK(before < 20);
  for (int i = 1; i <= 64; ++i) {
    const double now = lab(map_colour(i / 64.0))[0];
    CHECK(now > before);
    before = now;
  }
  CHECK(before > 90);
}

TEST_CASE("equal steps on the map are equal differences in colour", "[vision][false_colour]") {
  // Bytes round colours by up to about 1 in CIELAB, so steps of 1/16 (some 15 units) are compared.
  double least = 1e9, most = 0;
  for (int i = 0; i < 16; ++i) {
    const double d = difference(map_colour(i / 16.0), map_colour((i + 1) / 16.0));
    least = std::min(least, d);
    most = std::max(most, d);
  }
  INFO(least << " to " << most);
  CHECK(least > 8);
  CHECK(most < 1.15 * least);
}

TEST_CASE("the map runs from violet through teal to yellow", "[vision][false_colour]") {
  const Rgb8 first = map_colour(0), middle = map_colour(0.5), last = map_colour(1);
  CHECK(first.b > first.g);
  CHECK(first.r > first.g);
  CHECK(middle.g > middle.r);
  CHECK(last.r > last.b);
  CHECK(last.g > last.b);
  CHECK(map_colour(-3) == first);
  CHECK(map_colour(7) == last);
}

TEST_CASE("a scale places values linearly or by logarithm and clamps what lies outside",
          "[vision][false_colour]") {
  const FalseColourScale linear{0, 10, false};
  CHECK(linear.position(2.5) == Approx(0.25));
  CHECK(linear.position(-1) == 0);
  CHECK(linear.position(11) == 1);
  const FalseColourScale log{0.1, 1000, true};
  CHECK(log.position(1) == Approx(0.25));
  CHECK(log.position(100) == Approx(0.75));
  CHECK(log.position(0) == 0);
  CHECK(log.position(-5) == 0);
  CHECK(false_colour(log, std::nan("")) == no_value_colour);
  CHECK(false_colour(log, std::numeric_limits<double>::infinity()) == map_colour(1));
}

TEST_CASE("a picture has one colour per value", "[vision][false_colour]") {
  const FalseColourScale scale{0, 1, false};
  const SrgbPicture p = false_colour_picture({0.0f, 1.0f, std::nanf(""), 0.5f}, 2, 2, scale);
  REQUIRE(p.rgb.size() == 12);
  CHECK(Rgb8{p.rgb[0], p.rgb[1], p.rgb[2]} == map_colour(0));
  CHECK(Rgb8{p.rgb[3], p.rgb[4], p.rgb[5]} == map_colour(1));
  CHECK(Rgb8{p.rgb[6], p.rgb[7], p.rgb[8]} == no_value_colour);
  CHECK(Rgb8{p.rgb[9], p.rgb[10], p.rgb[11]} == map_colour(0.5));
}

TEST_CASE("a nice scale holds its values between nice numbers", "[vision][false_colour]") {
  const FalseColourScale lux = nice_scale({0.3f, 7.0f, 42.0f}, true);
  CHECK(lux.low == 0.2);
  CHECK(lux.high == 50);
  const FalseColourScale linear = nice_scale({0.3f, 7.0f, 42.0f}, false);
  CHECK(linear.low == 0);
  CHECK(linear.high == 50);
  CHECK(nice_scale({-3.0f, 1.0f}, false).low == -5);
  // Zeros and nonsense do not stretch a logarithmic scale; six decades do for all.
  CHECK(nice_scale({0.0f, -1.0f, std::nanf(""), 1e-12f, 100.0f}, true).low == Approx(1e-4));
  CHECK(nice_scale({5.0f, 5.0f}, true).high == 5);
  CHECK(nice_scale({5.0f, 5.0f}, true).low < 5);
  CHECK(nice_scale({}, false).high == 1);
  CHECK(nice_scale({}, true).low == 0.1);
  CHECK(nice_scale({0.0f}, false).high == 1);
}

TEST_CASE("ticks stand at numbers people read", "[vision][false_colour]") {
  CHECK(texts(nice_ticks({0.5, 20, true}, 8)) == "0.5 1 2 5 10 20");
  CHECK(texts(nice_ticks({0.01, 1000, true}, 8)) == "0.01 0.1 1 10 100 1000");
  CHECK(texts(nice_ticks({0, 50, false}, 6)) == "0 10 20 30 40 50");
  CHECK(texts(nice_ticks({0, 1, false}, 6)) == "0 0.2 0.4 0.6 0.8 1");
  CHECK(texts(nice_ticks({-5, 5, false}, 6)) == "-4 -2 0 2 4");
  CHECK(nice_ticks({1, 0, false}, 6).empty());
}

TEST_CASE("ticks ascend within the scale and are never more than asked for",
          "[vision][false_colour]") {
  for (bool logarithmic : {false, true})
    for (double low : {1e-6, 0.013, 0.5, 1.0})
      for (double span : {1.7, 3.0, 40.0, 1e5})
        for (int most : {2, 5, 10}) {
          const FalseColourScale scale{low, low * span, logarithmic};
          const auto ticks = nice_ticks(scale, most);
          CHECK(static_cast<int>(ticks.size()) <= most);
          double before = -1;
          for (const Tick& t : ticks) {
            CHECK(t.position > before);
            CHECK(t.position <= 1);
            CHECK(std::stod(t.text) == Approx(t.value).epsilon(1e-3));
            before = t.position;
          }
        }
}

TEST_CASE("numbers are written without exponents and trailing zeros", "[vision][false_colour]") {
  CHECK(number_text(0) == "0");
  CHECK(number_text(0.5) == "0.5");
  CHECK(number_text(20) == "20");
  CHECK(number_text(1000) == "1000");
  CHECK(number_text(0.0002) == "0.0002");
  CHECK(number_text(-0.25) == "-0.25");
  CHECK(number_text(1e7) == "1e+07");
}
