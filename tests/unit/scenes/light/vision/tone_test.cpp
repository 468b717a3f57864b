#include "scenes/light/vision/tone.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "scenes/light/optics/chromaticity.hpp"
#include "scenes/light/vision/mesopic.hpp"
#include "tests/unit/scenes/light/vision/linear_of_srgb.hpp"

using namespace luxodus;

namespace {

constexpr double pi = std::numbers::pi;

// A picture with these luminances in one row, all of one linear sRGB colour.
XyzPicture row(const std::vector<double>& luminances,
               const std::array<double, 3>& colour = {1, 1, 1}) {
  const Xyz c = xyz_from_linear_srgb(colour);
  XyzPicture p;
  p.width = static_cast<int>(luminances.size());
  p.height = 1;
  for (const double l : luminances)
    for (const double v : c) p.xyz.push_back(static_cast<float>(l * v / c[1]));
  return p;
}

struct Rgb8 {
  uint8_t r = 0, g = 0, b = 0;

  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};

Rgb8 at(const SrgbPicture& p, size_t i) {
  return {p.rgb[3 * i], p.rgb[3 * i + 1], p.rgb[3 * i + 2]};
}

double luminance(Rgb8 c) {
  return xyz_from_linear_srgb({test::linear_of_srgb_byte(c.r), test::linear_of_srgb_byte(c.g),
                               test::linear_of_srgb_byte(c.b)})[1];
}

int spread(Rgb8 c) {
  return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b});
}

std::array<double, 3> linear_of(Rgb8 c) {
  return {test::linear_of_srgb_byte(c.r), test::linear_of_srgb_byte(c.g),
          test::linear_of_srgb_byte(c.b)};
}

/// Oklab from linear sRGB, by the matrices that its author gives for sRGB (B. Ottosson 2020).
struct Oklab {
  double lightness = 0, a = 0, b = 0;

  double chroma() const { return std::hypot(a, b); }
  double hue() const { return std::atan2(b, a); }
};

Oklab oklab_of(const std::array<double, 3>& rgb) {
  const auto [r, g, b] = rgb;
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

/// Linear up to this luminance, which is white.
CameraCurve white_at(double cd_m2) {
  CameraCurve curve;
  curve.factor = 1 / cd_m2;
  return curve;
}

/// The picture by its own exposure.
SrgbPicture exposed(const XyzPicture& picture, double sign_cd_m2 = 0) {
  return tone_plain(picture, exposure_of(picture, sign_cd_m2).curve());
}

// Luminances evenly spaced in the logarithm.
std::vector<double> even_logs(double low, double high, int n) {
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(low * std::pow(high / low, i / (n - 1.0)));
  return out;
}

}  // namespace

TEST_CASE("sRGB bytes survive conversion to linear light and back", "[vision][picture]") {
  for (int i = 0; i < 256; ++i)
    CHECK(srgb_byte(test::linear_of_srgb_byte(static_cast<uint8_t>(i))) == i);
  CHECK(srgb_byte(-1) == 0);
  CHECK(srgb_byte(2) == 255);
  CHECK(srgb_byte(std::nan("")) == 0);
  CHECK(srgb_byte(0.2140) == 127);  // half of the linear scale
}

TEST_CASE("with a fixed white the picture is linear up to it and white above", "[vision][tone]") {
  const SrgbPicture p = tone_plain(row({0, 12.5, 50, 100, 1000}), white_at(100));
  CHECK(at(p, 0) == Rgb8{0, 0, 0});
  CHECK(luminance(at(p, 1)) == Approx(0.125).margin(0.003));
  CHECK(luminance(at(p, 2)) == Approx(0.5).margin(0.003));
  CHECK(at(p, 3) == Rgb8{255, 255, 255});
  CHECK(at(p, 4) == Rgb8{255, 255, 255});
}

TEST_CASE("without a white, the log-average becomes middle grey at any light level",
          "[vision][tone]") {
  for (const double level : {1e-3, 1.0, 1e4}) {
    const SrgbPicture p = exposed(row({level / 2, level, level * 2}));
    CHECK(luminance(at(p, 1)) == Approx(0.18).margin(0.003));
  }
}

TEST_CASE("the camera's curve is monotone, smooth at the knee, and ends at white",
          "[vision][tone]") {
  for (const double white : {1.0, 2.0, 50.0})
    for (const double sign : {0.0, 0.5, 1.0, 5.0, 900.0, 1e6}) {
      const CameraCurve curve = camera_curve(1, white, sign);
      INFO("white " << white << ", sign " << sign);
      double before = 0;
      for (const double x : even_logs(1e-6, curve.white, 2000)) {
        const double now = curve.shown(x);
        CHECK(now > before);
        CHECK(now <= x + 1e-12);
        before = now;
      }
      CHECK(curve.shown(curve.white) == 1);
      CHECK(curve.shown(10 * curve.white) == 1);
      const double h = 1e-6 * curve.knee;
      CHECK((curve.shown(curve.knee + h) - curve.shown(curve.knee)) / h ==
            Approx(curve.slope_at(curve.knee)).epsilon(1e-3));
      CHECK(curve.shown(std::nan("")) == 0);
    }
}

TEST_CASE("the contrast of film deepens shadows, lifts middle tones and keeps lights",
          "[vision][tone]") {
  double before = 0;
  for (const double v : even_logs(1e-5, 1, 2000)) {
    CHECK(film_contrast(v) > before);
    before = film_contrast(v);
  }
  CHECK(film_contrast(0) == 0);
  CHECK(film_contrast(0.003) < 0.5 * 0.003);
  CHECK(film_contrast(0.3) > 0.3);
  CHECK(film_contrast(0.3) < 0.35);
  for (const double light : {sign_level, 0.9, 1.0}) CHECK(film_contrast(light) == light);
}

TEST_CASE("pictures are metered together as if they were one", "[vision][tone]") {
  const std::vector<double> dark = even_logs(0.01, 1, 500), bright = even_logs(5, 900, 500);
  std::vector<double> both = dark;
  both.insert(both.end(), bright.begin(), bright.end());
  LightMeter meter = metered(row(dark), 0.4);
  meter.add(metered(row(bright), 70));
  meter.add(metered(row({0, 0, 0}), 0));  // of no light, and no weight
  const Exposure together = meter.exposure(), one = exposure_of(row(both), 70);
  CHECK(together.grey_cd_m2 == Approx(one.grey_cd_m2).epsilon(1e-12));
  CHECK(together.sign_cd_m2 == 70);
  CHECK(together.white_cd_m2 == exposure_of(row(bright), 70).white_cd_m2);
  CHECK(LightMeter().exposure().white_cd_m2 == Exposure().white_cd_m2);
}

TEST_CASE("the live view's curve is that of pictures", "[vision][tone]") {
  // The same numbers stand in tests/view/unit/tone_test.mjs.
  const CameraCurve curve = camera_curve(1, 20, 70);
  CHECK(curve.shown(0.18) == Approx(0.0515029537).epsilon(1e-8));
  CHECK(curve.shown(35) == Approx(0.5855394439).epsilon(1e-8));
  CHECK(curve.shown(100) == Approx(0.9543412475).epsilon(1e-8));
}

TEST_CASE("the brightest face of a sign is shown at 0.8 or less, and contrasts below it stay",
          "[vision][tone]") {
  const bool film = GENERATE(false, true);
  for (const double white : {1.0, 20.0, 1e4})
    for (const double sign : {0.3, 0.9, 3.0, 70.0, 4000.0, 1e6}) {
      CameraCurve curve = camera_curve(1, white, sign);
      curve.film = film;
      INFO("white " << white << ", sign " << sign << (film ? ", film" : ""));
      CHECK(curve.shown(sign) <= sign_level + 1e-12);
      if (curve.bend > 0) CHECK(curve.shown(sign) == Approx(sign_level));
      for (const double ratio : {1.1, 2.0, 5.0, 15.0, 1000.0})
        for (const double legend : {sign, sign / 3, sign / 50})
          CHECK(curve.shown(legend) / curve.shown(legend / ratio) >= std::pow(ratio, 0.4));
    }
}

TEST_CASE("colours more saturated than the monitor keep their luminance and leading channel",
          "[vision][tone]") {
  // Monochromatic 520 nm, far outside sRGB.
  XyzPicture p;
  p.width = p.height = 1;
  const double k = 30 / cie_y().at(520);
  p.xyz = {static_cast<float>(k * cie_x().at(520)), 30.0f, static_cast<float>(k * cie_z().at(520))};
  const Rgb8 c = at(tone_plain(p, white_at(100)), 0);
  CHECK(luminance(c) == Approx(0.3).margin(0.005));
  CHECK(c.g > c.r);
  CHECK(c.g > c.b);
}

TEST_CASE("a light too bright for the monitor keeps its hue and pales", "[vision][tone]") {
  // The green of a sign, the orange of a flame, a blue lamp; all but the darkest are overexposed.
  for (const std::array<double, 3>& colour :
       {std::array<double, 3>{0.05, 1, 0.4}, {1, 0.35, 0.05}, {0.1, 0.2, 1}}) {
    const double level = xyz_from_linear_srgb(colour)[1];  // the brightest that is shown saturated
    double before = 0, chroma_before = 1;
    const double rest = 1 - level;
    for (const double shown :
         {0.3 * level, 0.98 * level, level + 0.2 * rest, level + 0.6 * rest, 1.0}) {
      const Rgb8 c = at(tone_plain(row({100 * shown}, colour), white_at(100)), 0);
      INFO("colour " << colour[0] << " " << colour[1] << " " << colour[2] << ", shown " << shown);
      CHECK(luminance(c) == Approx(shown).margin(0.006));
      CHECK(luminance(c) > before);
      before = luminance(c);
      const Oklab seen = oklab_of(linear_of(c)), whole = oklab_of(colour);
      CHECK(seen.chroma() / seen.lightness <= chroma_before + 0.01);
      chroma_before = seen.chroma() / seen.lightness;
      if (shown < 0.99) CHECK(std::abs(std::remainder(seen.hue() - whole.hue(), 2 * pi)) < 0.06);
    }
    CHECK(chroma_before < 0.01);  // as bright as white is white
  }
}

TEST_CASE("a flame is brighter than the wall that it lights, in the hue of fire",
          "[vision][tone]") {
  // A room of 30 cd/m2, a wall of 300, a flame of 4000.
  const std::array<double, 3> orange{1, 0.27, 0.01};
  XyzPicture p = row(std::vector<double>(950, 30), orange);
  for (const double level : {300.0, 4000.0}) {
    const XyzPicture more = row(std::vector<double>(25, level), orange);
    p.xyz.insert(p.xyz.end(), more.xyz.begin(), more.xyz.end());
  }
  p.width = 1000;
  HumanTone eye;
  eye.glare = false;  // a row of pixels has no surroundings
  for (const SrgbPicture& out : {exposed(p), tone_human(p, eye)}) {
    const Rgb8 room = at(out, 0), wall = at(out, 960), flame = at(out, 990);
    CHECK(luminance(flame) > luminance(wall) + 0.02);
    CHECK(luminance(wall) > luminance(room) + 0.05);
    CHECK(std::abs(oklab_of(linear_of(room)).hue() - oklab_of(orange).hue()) < 0.06);
    // A pale colour has few bytes left for its hue.
    CHECK(std::abs(oklab_of(linear_of(wall)).hue() - oklab_of(orange).hue()) < 0.2);
  }
}

namespace {

/// Random colours, many of them saturated, of luminances spread over eight decades from `low`.
XyzPicture random_lights(double low, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  XyzPicture p;
  p.width = 4000;
  p.height = 1;
  for (int i = 0; i < p.width; ++i) {
    std::array<double, 3> colour{};
    for (double& v : colour) v = 1e-3 + std::pow(share(random), 4);
    const double level = low * std::pow(1e8, share(random));
    const Xyz c = xyz_from_linear_srgb(colour);
    for (const double v : c) p.xyz.push_back(static_cast<float>(level * v / c[1]));
  }
  return p;
}

/// Largest fall of the code value, that of the grey as bright as the pixel, while `level` of the
/// picture's pixels rises.
int largest_inversion(const SrgbPicture& out, const std::vector<double>& level) {
  std::vector<size_t> order(level.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return level[a] < level[b]; });
  int highest = 0, inversion = 0;
  for (const size_t i : order) {
    const int code = srgb_byte(luminance(at(out, i)));
    inversion = std::max(inversion, highest - code);
    highest = std::max(highest, code);
  }
  return inversion;
}

std::vector<double> photopic(const XyzPicture& p) {
  std::vector<double> out;
  for (size_t i = 0; i < p.pixels(); ++i) out.push_back(static_cast<double>(p.xyz[3 * i + 1]));
  return out;
}

}  // namespace

TEST_CASE("no colour is shown brighter than one of more luminance", "[vision][tone]") {
  for (const uint64_t seed : {1u, 2u, 3u}) {
    const XyzPicture p = random_lights(1e-3, seed);
    for (const double sign : {0.0, 1.0, 500.0, 5e4}) {
      CHECK(largest_inversion(exposed(p, sign), photopic(p)) <= 1);
    }
    CHECK(largest_inversion(tone_plain(p, white_at(100)), photopic(p)) <= 1);
  }
}

TEST_CASE("a human view keeps the order of mesopic luminance", "[vision][tone]") {
  HumanTone eye;
  eye.degrees_per_pixel = 0;  // neither glare nor blur: pixels are seen as they are
  for (const uint64_t seed : {1u, 2u, 3u}) {
    // All cones: mesopic luminance is luminance.
    const XyzPicture day = random_lights(10, seed);
    CHECK(largest_inversion(tone_human(day, eye), photopic(day)) <= 1);
    // All rods: it is scotopic luminance.
    XyzPicture night = random_lights(1e-12, seed);
    std::vector<double> scotopic;
    for (size_t i = 0; i < night.pixels(); ++i) {
      const float* xyz = &night.xyz[3 * i];
      const double s = scotopic_from_xyz(static_cast<double>(xyz[0]), static_cast<double>(xyz[1]),
                                         static_cast<double>(xyz[2]));
      scotopic.push_back(std::clamp(s, 1e-6, 1e-4));
      night.scotopic.push_back(static_cast<float>(scotopic.back()));
    }
    CHECK(largest_inversion(tone_human(night, eye), scotopic) <= 1);
  }
}

TEST_CASE("a legend shows at least the 0.4th power of its ratio to its ground", "[vision][tone]") {
  // Signs of usual colours and of smoke-reddened ones, in rooms from dark to bright.
  const std::array<double, 3> white{1, 1, 1}, green{0.05, 1, 0.4}, reddened{1, 0.55, 0.15},
      reddened_green{0.6, 1, 0.02}, red{1, 0.03, 0.02};
  const std::vector<std::pair<std::array<double, 3>, std::array<double, 3>>> signs{
      {white, green}, {reddened, reddened_green}, {white, red}, {red, white}, {green, white}};
  for (const double room : {1e-3, 0.1, 10.0, 300.0})
    for (const double level : {0.2, 3.2, 75.0, 500.0})
      for (const double ratio : {1.5, 3.5, 5.0, 15.0})
        for (const auto& [legend, ground] : signs) {
          XyzPicture p = row(std::vector<double>(900, room));
          for (const XyzPicture& face : {row(std::vector<double>(20, level), legend),
                                         row(std::vector<double>(80, level / ratio), ground)})
            p.xyz.insert(p.xyz.end(), face.xyz.begin(), face.xyz.end());
          p.width = 1000;
          const SrgbPicture out = exposed(p, level);
          const double shown = luminance(at(out, 910)), behind = luminance(at(out, 950));
          if (behind < 0.002) continue;  // a few code values, and bytes are rounded
          INFO("room " << room << ", legend " << level << ", ratio " << ratio << ": " << shown
                       << " over " << behind);
          CHECK(shown / behind >= std::pow(ratio, 0.4));
        }
}

TEST_CASE("the white legend of an overexposed sign is readable on its green", "[vision][tone]") {
  // A dark corridor of 0.1 cd/m2; the sign has 75 and 15.
  XyzPicture p = row(std::vector<double>(900, 0.1));
  const XyzPicture white = row(std::vector<double>(20, 75));
  const XyzPicture green = row(std::vector<double>(80, 15), {0.05, 1, 0.4});
  p.xyz.insert(p.xyz.end(), white.xyz.begin(), white.xyz.end());
  p.xyz.insert(p.xyz.end(), green.xyz.begin(), green.xyz.end());
  p.width = 1000;
  HumanTone eye;
  eye.sign_cd_m2 = 75;
  for (const SrgbPicture& out : {exposed(p, 75), tone_human(p, eye)}) {
    const Rgb8 legend = at(out, 910), background = at(out, 950);
    CHECK(spread(legend) <= 2);
    CHECK(spread(background) > 100);
    CHECK(luminance(legend) - luminance(background) > 0.2);
  }
}

TEST_CASE("invalid pixels are black and do not affect others", "[vision][tone]") {
  XyzPicture p = row({10, 10, 10, 10});
  p.xyz[0] = std::nanf("");
  p.xyz[4] = -1.0f;
  p.xyz[8] = INFINITY;
  for (const SrgbPicture& out : {exposed(p), tone_human(p, {})}) {
    REQUIRE(out.rgb.size() == 12);
    CHECK(at(out, 0) == Rgb8{0, 0, 0});
    CHECK(at(out, 1) == Rgb8{0, 0, 0});
    CHECK(at(out, 2) == Rgb8{0, 0, 0});
  }
  CHECK(luminance(at(exposed(p), 3)) == Approx(0.18).margin(0.003));
  CHECK(exposed(XyzPicture{}).rgb.empty());
  CHECK(tone_human(XyzPicture{}, {}).rgb.empty());
  CHECK(at(tone_human(row({0, 0}), {}), 0) == Rgb8{0, 0, 0});
}

TEST_CASE("the human threshold has the published contrasts", "[vision][tone]") {
  // dL/L at .01, .1, 1, 10, 100 cd/m2.
  const std::array<double, 5> contrast{0.547, 0.403, 0.391, 0.107, 0.056};
  double l = 0.01;
  for (const double c : contrast) {
    CHECK(threshold_difference_cd_m2(l) / l == Approx(c).margin(6e-4));
    l *= 10;
  }
  CHECK(threshold_difference_cd_m2(0) == 1.38e-3);
}

TEST_CASE("a scene that fits the display is shown by one factor", "[vision][tone]") {
  const ToneCurve curve = human_curve(even_logs(5, 50, 500), {});
  CHECK(curve.linear);
  CHECK(curve.display(20) == Approx(2 * curve.display(10)));
  CHECK(curve.display(1e9) == Approx(1e8 * curve.display(10)));
}

TEST_CASE("the human curve rises from the display's black to its white", "[vision][tone]") {
  const MonitorModel monitor{200, 1};
  const ToneCurve curve = human_curve(even_logs(0.01, 1e4, 2000), monitor);
  REQUIRE_FALSE(curve.linear);
  CHECK(curve.display(0.01) == Approx(1).epsilon(1e-6));
  CHECK(curve.display(1e4) == Approx(200).epsilon(1e-6));
  double before = 0;
  for (const double l : even_logs(0.001, 1e5, 500)) {
    CHECK(curve.display(l) >= before);
    before = curve.display(l);
  }
  CHECK(curve.display(0) == 0);
}

TEST_CASE("the human curve never shows a contrast that an eye could not see in the scene",
          "[vision][tone]") {
  // A corridor: most of the view between 0.05 and 0.2 cd/m2, a few degrees of sign and lamp.
  std::vector<double> scene = even_logs(0.05, 0.2, 1500);
  for (const double l : even_logs(0.2, 2000, 100)) scene.push_back(l);
  const ToneCurve curve = human_curve(scene, {});
  REQUIRE_FALSE(curve.linear);
  // dL_d / dL_w <= dL_t(L_d) / dL_t(L_w); the trimming stops within a tolerance and works on bins,
  // which the factor of a tenth allows for.
  for (size_t k = 1; k < curve.log_world.size(); ++k) {
    const double w = std::exp(0.5 * (curve.log_world[k] + curve.log_world[k - 1]));
    const double d = std::exp(0.5 * (curve.log_display[k] + curve.log_display[k - 1]));
    const double slope = (curve.log_display[k] - curve.log_display[k - 1]) /
                         (curve.log_world[k] - curve.log_world[k - 1]) * d / w;
    const double allowed = threshold_difference_cd_m2(d) / threshold_difference_cd_m2(w);
    CHECK(slope <= 1.1 * allowed);
  }
  // The crowded dark part is not stretched to fill the display, as plain histogram equalisation
  // would.
  CHECK(curve.display(0.2) < 100);
}

TEST_CASE("a night scene loses its colour and a day scene keeps it", "[vision][tone]") {
  const std::array<double, 3> green{0.1, 1, 0.3};
  const auto shown = [&](double level) {
    return at(tone_human(row({level / 2, level, level * 2}, green), {}), 1);
  };
  const Rgb8 night = shown(0.002), dusk = shown(0.1), day = shown(100);
  CHECK(spread(night) <= 2);
  CHECK(spread(day) > 60);
  HumanTone keep;
  keep.lose_colour = false;
  const Rgb8 kept = at(tone_human(row({0.05, 0.1, 0.2}, green), keep), 1);
  CHECK(spread(kept) > spread(dusk));
}

TEST_CASE("a scotopic channel replaces the estimate", "[vision][tone]") {
  XyzPicture p = row({0.001, 0.002, 0.004});
  p.scotopic = {0.001f, 0.010f, 0.004f};
  const SrgbPicture out = tone_human(p, {});
  // The middle pixel is the brightest for rods, although the last has the highest luminance.
  CHECK(at(out, 1).g > at(out, 2).g);
}

TEST_CASE("adaptation is taken over one degree of view", "[vision][tone]") {
  // A pixel-fine checkerboard of 0.001 and 20 cd/m2: averaged over a degree, the eye is photopic
  // everywhere, so the dark pixels keep their colour; taken per pixel they would be scotopic.
  std::vector<double> lights;
  for (int i = 0; i < 64 * 64; ++i) lights.push_back((i + i / 64) % 2 == 0 ? 0.001 : 20);
  XyzPicture p = row(lights, {0.2, 1, 0.2});
  p.width = p.height = 64;
  HumanTone coarse;
  coarse.degrees_per_pixel = 0.25;
  const Rgb8 lit = at(tone_human(p, coarse), 64 * 32 + 31);
  CHECK(spread(lit) > 60);
}

// ---- the published operator, on test patterns --------------------------------------------------

namespace {

// Adaptation luminances of typical views.
std::vector<std::vector<double>> test_patterns() {
  std::vector<std::vector<double>> patterns;
  patterns.push_back(even_logs(1e-4, 1e4, 2000));  // a ramp over eight decades
  // A dark room with a window: two levels, four decades apart.
  std::vector<double> window = even_logs(0.02, 0.2, 900);
  for (const double l : even_logs(500, 5000, 100)) window.push_back(l);
  patterns.push_back(window);
  // A crowded middle with long tails.
  std::vector<double> crowd = even_logs(1e-3, 3e3, 100);
  for (const double l : even_logs(0.8, 1.2, 3000)) crowd.push_back(l);
  patterns.push_back(crowd);
  return patterns;
}

const std::array<MonitorModel, 3> monitors{MonitorModel{100, 0.5}, MonitorModel{200, 1},
                                           MonitorModel{1000, 0.01}};

// A grating of bars two pixels wide; the upper half of the picture is blank at the same mean.
XyzPicture grating(double mean_cd_m2) {
  std::vector<double> lights;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x)
      lights.push_back(y < 24 ? mean_cd_m2 : mean_cd_m2 * (x / 2 % 2 == 0 ? 1.6 : 0.4));
  XyzPicture p = row(lights);
  p.width = p.height = 48;
  return p;
}

// Michelson contrast of the grating as shown, far from edges.
double shown_contrast(const SrgbPicture& p) {
  double low = 1, high = 0;
  for (size_t x = 16; x < 32; ++x) {
    const double l = luminance(at(p, 48 * 38 + x));
    low = std::min(low, l);
    high = std::max(high, l);
  }
  return (high - low) / (high + low);
}

}  // namespace

TEST_CASE("on every monitor the human curve is monotone, and ends at its black and its white",
          "[vision][tone]") {
  for (const MonitorModel& monitor : monitors)
    for (const std::vector<double>& pattern : test_patterns()) {
      const ToneCurve curve = human_curve(pattern, monitor);
      double before = 0;
      for (const double l : even_logs(1e-5, 1e5, 1000)) {
        const double shown = curve.display(l);
        CHECK(shown >= before);
        if (!curve.linear) CHECK(shown <= monitor.white_cd_m2 * (1 + 1e-9));
        before = shown;
      }
      if (curve.linear) continue;
      CHECK(curve.display(std::exp(curve.log_world.front())) == Approx(monitor.black_cd_m2));
      CHECK(curve.display(1e5) == Approx(monitor.white_cd_m2));
    }
}

TEST_CASE("no monitor shows a pattern with more contrast than an eye sees in it",
          "[vision][tone]") {
  for (const MonitorModel& monitor : monitors)
    for (const std::vector<double>& pattern : test_patterns()) {
      const ToneCurve curve = human_curve(pattern, monitor);
      if (curve.linear) continue;
      for (size_t k = 1; k < curve.log_world.size(); ++k) {
        const double w = std::exp(0.5 * (curve.log_world[k] + curve.log_world[k - 1]));
        const double d = std::exp(0.5 * (curve.log_display[k] + curve.log_display[k - 1]));
        const double slope = (curve.log_display[k] - curve.log_display[k - 1]) /
                             (curve.log_world[k] - curve.log_world[k - 1]) * d / w;
        // The trimming stops within its tolerance.
        CHECK(slope <= 1.1 * threshold_difference_cd_m2(d) / threshold_difference_cd_m2(w));
      }
    }
}

TEST_CASE("a grey ramp is shown as a ramp", "[vision][tone]") {
  std::vector<double> lights;
  for (int y = 0; y < 8; ++y)
    for (const double l : even_logs(1e-4, 1e3, 256)) lights.push_back(l);
  XyzPicture p = row(lights);
  p.width = 256;
  p.height = 8;
  for (const MonitorModel& monitor : monitors) {
    HumanTone tone;
    tone.monitor = monitor;
    tone.glare = false;  // seven decades in 25 degrees dazzle: only veil at the dark end
    const SrgbPicture out = tone_human(p, tone);
    for (size_t x = 1; x < 256; ++x) CHECK(at(out, 4 * 256 + x).g >= at(out, 4 * 256 + x - 1).g);
    CHECK(at(out, 4 * 256 + 255).g > at(out, 4 * 256).g + 100);
  }
}

TEST_CASE("acuity is 50 cycles a degree in daylight and falls to a few in the dark",
          "[vision][tone]") {
  // S. Shlaer 1937, as plotted by Ward Larson et al. 1997.
  CHECK(visual_acuity_cycles_per_degree(1000) == Approx(49).margin(2));
  CHECK(visual_acuity_cycles_per_degree(1) == Approx(31.5).margin(2));
  CHECK(visual_acuity_cycles_per_degree(0.001) == Approx(3).margin(1));
  double before = 0;
  for (const double l : even_logs(1e-7, 1e5, 200)) {
    const double acuity = visual_acuity_cycles_per_degree(l);
    CHECK(acuity > 0);
    CHECK(acuity >= before);
    before = acuity;
  }
}

TEST_CASE("a grating that an eye resolves in the light fades in the dark", "[vision][tone]") {
  // Bars of 0.06 degrees: 8.3 cycles a degree.
  HumanTone eye;
  eye.degrees_per_pixel = 0.03;
  HumanTone sharp = eye;
  sharp.lose_acuity = false;
  const auto kept = [&](double mean) {
    return shown_contrast(tone_human(grating(mean), eye)) /
           shown_contrast(tone_human(grating(mean), sharp));
  };
  CHECK(tone_human(grating(100), eye).rgb == tone_human(grating(100), sharp).rgb);
  CHECK(tone_human(grating(1), eye).rgb == tone_human(grating(1), sharp).rgb);
  const double dusk = kept(0.05), night = kept(0.02), darkest = kept(0.004);
  INFO("contrast kept: " << dusk << ", " << night << ", " << darkest);
  CHECK(dusk < 0.95);
  CHECK(night < 0.85 * dusk);
  CHECK(darkest < 0.5 * night);
}

TEST_CASE("unresolved detail keeps its mean, and a uniform field stays as it is",
          "[vision][tone]") {
  HumanTone eye;
  eye.degrees_per_pixel = 0.03;
  HumanTone sharp = eye;
  sharp.lose_acuity = false;
  XyzPicture even = row(std::vector<double>(32 * 32, 0.004), {0.3, 1, 0.5});
  even.width = even.height = 32;
  even.scotopic.assign(32 * 32, 0.008f);
  CHECK(tone_human(even, eye).rgb == tone_human(even, sharp).rgb);
  // The blank half has the grating's mean.
  const SrgbPicture out = tone_human(grating(0.004), eye);
  double sum = 0;
  for (size_t x = 16; x < 32; ++x) sum += luminance(at(out, 48 * 38 + x)) / 16;
  CHECK(sum == Approx(luminance(at(out, 48 * 10 + 24))).epsilon(0.1));
}

TEST_CASE("colours fade gradually as vision changes from cones to rods", "[vision][tone]") {
  HumanTone sharp;
  sharp.lose_acuity = false;
  double before = 1;
  for (const double level : {10.0, 1.0, 0.1, 0.03, 0.01, 0.001}) {
    const Rgb8 c = at(tone_human(row({level / 2, level, level * 2}, {0.1, 1, 0.3}), sharp), 1);
    const std::array<double, 3> rgb{test::linear_of_srgb_byte(c.r), test::linear_of_srgb_byte(c.g),
                                    test::linear_of_srgb_byte(c.b)};
    const double least = *std::min_element(rgb.begin(), rgb.end());
    const double most = *std::max_element(rgb.begin(), rgb.end());
    REQUIRE(most > 0);
    const double saturation = 1 - least / most;
    CHECK(saturation <= before + 0.03);  // bytes
    before = saturation;
  }
  CHECK(before < 0.1);
}
