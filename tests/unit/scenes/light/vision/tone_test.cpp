#include "scenes/light/vision/tone.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/light/optics/chromaticity.hpp"
#include "tests/unit/scenes/light/vision/linear_of_srgb.hpp"

using namespace luxodus;

namespace {

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

PlainTone white_at(double cd_m2) {
  PlainTone t;
  t.white_cd_m2 = cd_m2;
  return t;
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
    const SrgbPicture p = tone_plain(row({level / 2, level, level * 2}), {});
    CHECK(luminance(at(p, 1)) == Approx(0.18).margin(0.003));
  }
}

TEST_CASE("the shoulder is monotone, smooth at the knee, and ends at white", "[vision][tone]") {
  for (const double white : {1.0, 2.0, 50.0}) {
    double before = 0;
    for (double x = 0.01; x < white; x += 0.01) {
      const double now = shoulder(x, white);
      CHECK(now > before);
      CHECK(now <= x + 1e-12);
      before = now;
    }
    CHECK(shoulder(white, white) == 1);
    CHECK(shoulder(10 * white, white) == 1);
    const double h = 1e-6;
    CHECK((shoulder(shoulder_knee + h, white) - shoulder_knee) / h == Approx(1).epsilon(1e-3));
  }
  CHECK(shoulder(std::nan(""), 2) == 0);
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

TEST_CASE("the colour of a light is the same at every exposure, even far beyond white",
          "[vision][tone]") {
  // The green of a sign, the orange of a flame, a blue lamp; all but the darkest are overexposed.
  for (const std::array<double, 3>& colour :
       {std::array<double, 3>{0.05, 1, 0.4}, {1, 0.35, 0.05}, {0.1, 0.2, 1}}) {
    const SrgbPicture p = tone_plain(row({20, 100, 1000, 1e6}, colour), white_at(100));
    for (size_t i = 0; i < 4; ++i) {
      const Rgb8 c = at(p, i);
      const std::array<double, 3> rgb{test::linear_of_srgb_byte(c.r),
                                      test::linear_of_srgb_byte(c.g),
                                      test::linear_of_srgb_byte(c.b)};
      const double most = *std::max_element(rgb.begin(), rgb.end());
      for (size_t k = 0; k < 3; ++k) CHECK(rgb[k] / most == Approx(colour[k]).margin(0.01));
    }
    CHECK(luminance(at(p, 1)) > luminance(at(p, 0)));
  }
}

TEST_CASE("a flame far beyond a picture's white turns yellow, and the wall behind it stays orange",
          "[vision][tone]") {
  // A room of 30 cd/m2, a wall of 300, a flame of 2000 to 4300.
  const std::array<double, 3> orange{1, 0.27, 0.01};
  XyzPicture p = row(std::vector<double>(950, 30), orange);
  for (const double level : {300.0, 2000.0, 4300.0}) {
    const XyzPicture more = row(std::vector<double>(level > 1000 ? 20 : 10, level), orange);
    p.xyz.insert(p.xyz.end(), more.xyz.begin(), more.xyz.end());
  }
  p.width = 1000;
  const SrgbPicture out = tone_plain(p, {});
  const Rgb8 room = at(out, 0), wall = at(out, 955), edge = at(out, 965), core = at(out, 990);
  const auto green = [](const Rgb8& c) { return test::linear_of_srgb_byte(c.g); };
  CHECK(green(wall) / test::linear_of_srgb_byte(wall.r) ==
        Approx(green(room) / test::linear_of_srgb_byte(room.r)).margin(0.02));
  CHECK(green(core) > green(wall) + 0.2);
  CHECK(green(core) > green(edge) + 0.05);
  CHECK(core.b < core.g);
  // A sign keeps its green however far beyond white it is.
  XyzPicture signs = row(std::vector<double>(990, 1));
  const std::array<double, 3> sign_green{0.05, 1, 0.4};
  const XyzPicture sign = row(std::vector<double>(10, 1000), sign_green);
  signs.xyz.insert(signs.xyz.end(), sign.xyz.begin(), sign.xyz.end());
  signs.width = 1000;
  const Rgb8 shown = at(tone_plain(signs, {}), 995);
  CHECK(test::linear_of_srgb_byte(shown.b) ==
        Approx(0.4 * test::linear_of_srgb_byte(shown.g)).margin(0.01));
}

TEST_CASE("in a human view a flame is yellow, the wall beside it orange, and a sign green",
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
  const SrgbPicture out = tone_human(p, eye);
  const auto green = [](const Rgb8& c) {
    return test::linear_of_srgb_byte(c.g) / test::linear_of_srgb_byte(c.r);
  };
  const Rgb8 wall = at(out, 960), flame = at(out, 990);
  CHECK(green(flame) > green(wall) + 0.1);
  CHECK(luminance(flame) > luminance(wall) + 0.1);
  CHECK(flame.b < flame.g);
  const SrgbPicture sign = tone_human(row({1, 10, 3000}, {0.05, 1, 0.4}), eye);
  CHECK(test::linear_of_srgb_byte(at(sign, 2).b) ==
        Approx(0.4 * test::linear_of_srgb_byte(at(sign, 2).g)).margin(0.02));
}

TEST_CASE("the white legend of an overexposed sign is readable on its green", "[vision][tone]") {
  // A dark corridor of 0.1 cd/m2; the sign has 75 and 15.
  XyzPicture p = row(std::vector<double>(900, 0.1));
  const XyzPicture white = row(std::vector<double>(20, 75));
  const XyzPicture green = row(std::vector<double>(80, 15), {0.05, 1, 0.4});
  p.xyz.insert(p.xyz.end(), white.xyz.begin(), white.xyz.end());
  p.xyz.insert(p.xyz.end(), green.xyz.begin(), green.xyz.end());
  p.width = 1000;
  for (const SrgbPicture& out : {tone_plain(p, {}), tone_human(p, {})}) {
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
  for (const SrgbPicture& out : {tone_plain(p, {}), tone_human(p, {})}) {
    REQUIRE(out.rgb.size() == 12);
    CHECK(at(out, 0) == Rgb8{0, 0, 0});
    CHECK(at(out, 1) == Rgb8{0, 0, 0});
    CHECK(at(out, 2) == Rgb8{0, 0, 0});
  }
  CHECK(luminance(at(tone_plain(p, {}), 3)) == Approx(0.18).margin(0.003));
  CHECK(tone_plain(XyzPicture{}, {}).rgb.empty());
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
  CHECK(curve.display(1e9) == 200);
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
        CHECK(shown <= monitor.white_cd_m2 * (1 + 1e-9));
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
