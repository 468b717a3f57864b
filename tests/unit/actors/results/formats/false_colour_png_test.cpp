#include "actors/results/formats/false_colour_png.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "actors/results/formats/contour_lines.hpp"
#include "actors/results/formats/light_colours.hpp"
#include "actors/results/formats/plot_axis.hpp"
#include "tests/kit/temporary_folder.hpp"

// fontconfig keeps what it has read until the process ends; the leak sanitizer need not report it.
// Weak, so that the test program can define its own suppressions.
extern "C" __attribute__((weak)) const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}

using namespace luxodus;
using Catch::Matchers::Contains;

namespace {

const SourcePlace place{"picture.png", 0};
using Rgb = std::array<uint8_t, 3>;

FalseColourPicture example(int cells_u, int cells_v) {
  FalseColourPicture p;
  p.title = "Escape route";
  p.quantity = "Illuminance";
  p.unit = "lx";
  p.cells_u = cells_u;
  p.cells_v = cells_v;
  p.length_u_m = cells_u * 0.25;
  p.length_v_m = cells_v * 0.25;
  for (int v = 0; v < cells_v; ++v) {
    for (int u = 0; u < cells_u; ++u) p.values.push_back(0.2 + u + 0.1 * v);
  }
  p.contours = {0.5, 1, 5};
  p.width_px = 800;
  return p;
}

PngImage drawn(const FalseColourPicture& picture) {
  Result<PngImage> image = draw_false_colour(picture, place);
  REQUIRE(image.ok());
  return image.value();
}

size_t count_colour(const PngImage& image, const Rgb& colour) {
  size_t count = 0;
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    if (std::equal(colour.begin(), colour.end(), image.rgb.begin() + static_cast<long>(i))) ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("every value is painted in the colour of its place on the scale", "[format][colour]") {
  // Four flat cells, no interpolation: the picture holds just these colours, each in equal share.
  FalseColourPicture p = example(2, 2);
  p.values = {0, 1, 2, 4};
  p.contours.clear();
  p.smooth = false;
  p.mark_minimum = false;
  p.scale = ColourScale::linear;
  p.scale_low = 0;
  p.scale_high = 4;
  const Rgb zero = light_colour(0), one = light_colour(0.25), two = light_colour(0.5),
            four = light_colour(1);
  const PngImage image = drawn(p);
  const double expected = static_cast<double>(count_colour(image, zero));
  CHECK(expected > 10000);
  CHECK(count_colour(image, one) == Approx(expected).epsilon(0.02));
  CHECK(count_colour(image, two) == Approx(expected).epsilon(0.02));
  CHECK(count_colour(image, four) == Approx(expected).epsilon(0.02));

  // Row 0 is at the bottom, column 0 at the left.
  const auto where = [&](const Rgb& colour) {
    double x = 0, y = 0, n = 0;
    for (size_t i = 0; i < image.rgb.size() / 3; ++i) {
      if (!std::equal(colour.begin(), colour.end(), image.rgb.begin() + static_cast<long>(3 * i))) {
        continue;
      }
      x += static_cast<double>(i % static_cast<size_t>(image.width));
      y += static_cast<double>(i / static_cast<size_t>(image.width));
      ++n;
    }
    return glm::dvec2(x / n, y / n);
  };
  CHECK(where(zero).x < where(one).x - 50);
  CHECK(where(zero).y > where(two).y + 50);
}

TEST_CASE("a logarithmic scale gives every decade the same length", "[format][colour]") {
  FalseColourPicture p = example(3, 1);
  p.values = {0.1, 1, 10};
  p.scale = ColourScale::automatic;
  p.smooth = false;
  p.mark_minimum = false;
  const PngImage image = drawn(p);
  const double cell = static_cast<double>(count_colour(image, light_colour(0)));
  CHECK(cell > 10000);
  CHECK(count_colour(image, light_colour(0.5)) == Approx(cell).epsilon(0.02));
  // The legend's last step has the colour of the scale's end, too.
  CHECK(count_colour(image, light_colour(1)) == Approx(cell).epsilon(0.04));
}

TEST_CASE("cells without a value are hatched, and a line says how many there are",
          "[format][colour]") {
  FalseColourPicture p = example(20, 10);
  const PngImage whole = drawn(p);
  CHECK(count_colour(whole, {226, 229, 232}) == 0);
  p.values[7] = std::nan("");
  p.values[8] = std::numeric_limits<double>::infinity();
  const PngImage gaps = drawn(p);
  CHECK(count_colour(gaps, {226, 229, 232}) > 100);
  CHECK(gaps.height > whole.height);  // the line that says so
}

TEST_CASE("every grid gives a picture: flat, empty, negative, one cell, very long",
          "[format][colour]") {
  for (const double value : {0.0, 5.0, -3.0, 1e-300, 1e300, std::nan("")}) {
    FalseColourPicture p = example(4, 3);
    for (double& v : p.values) v = value;
    CHECK(drawn(p).width == 800);
    p.scale = ColourScale::logarithmic;
    CHECK(drawn(p).width == 800);
  }
  CHECK(drawn(example(1, 1)).height > 0);
  CHECK(drawn(example(400, 1)).height < 600);
  CHECK(drawn(example(1, 400)).height < 1000);
  FalseColourPicture p = example(5, 5);
  p.title = std::string(5000, 'x') + "\xff";
  p.quantity = p.unit = p.subtitle = p.label_u = p.title;
  p.notes = {p.title, "", "\x01"};
  p.origin_u_m = 1e7;
  CHECK(drawn(p).width == 800);
}

TEST_CASE("a picture has its numbers in its metadata and is the same every time",
          "[format][colour]") {
  FalseColourPicture p = example(20, 10);
  p.text = {{"Software", "luxodus"}};
  const PngImage image = drawn(p);
  REQUIRE(image.text.size() == 3);
  CHECK(image.text[0] == ImageText{"Title", "Escape route"});
  CHECK_THAT(image.text[1].second, Contains("minimum 0.2") && Contains("maximum 20.0"));
  CHECK(image.text[2] == ImageText{"Software", "luxodus"});
  CHECK(image.rgb == drawn(p).rgb);
}

TEST_CASE("a grid with contradictory sizes is rejected with its numbers", "[format][colour]") {
  const auto refusal = [](auto change) {
    FalseColourPicture p = example(4, 3);
    change(p);
    const Result<PngImage> image = draw_false_colour(p, place);
    REQUIRE_FALSE(image.ok());
    return image.problem().what;
  };
  using P = FalseColourPicture;
  CHECK_THAT(refusal([](P& p) { p.values.pop_back(); }), Contains("4 x 3 cells has 11 values"));
  CHECK_THAT(refusal([](P& p) { p.cells_u = 0; }), Contains("0 x 3"));
  CHECK_THAT(refusal([](P& p) { p.cells_u = 100000; }), Contains("cannot be drawn"));
  CHECK_THAT(refusal([](P& p) { p.length_v_m = 0; }), Contains("longer than zero"));
  CHECK_THAT(refusal([](P& p) { p.length_u_m = NAN; }), Contains("longer than zero"));
  CHECK_THAT(refusal([](P& p) { p.width_px = 10; }), Contains("pixels wide"));
  CHECK_THAT(refusal([](P& p) { p.scale_low = 10, p.scale_high = 1; }), Contains("no order"));
  CHECK_THAT(refusal([](P& p) {
               p.scale = ColourScale::logarithmic;
               p.scale_low = 0;
             }),
             Contains("above zero"));
  const test::TemporaryFolder folder;
  CHECK(write_false_colour_png(folder / "a.png", example(4, 3)).ok());
  CHECK_THAT(write_false_colour_png(folder / "none" / "a.png", example(4, 3)).problem().text(),
             Contains("none/a.png") && Contains("No such file"));
}

TEST_CASE("a contour of a cone is a circle of the right radius, closed", "[format][contour]") {
  std::vector<double> axis, values;
  for (int i = 0; i <= 100; ++i) axis.push_back(-1 + 0.02 * i);
  for (const double y : axis) {
    for (const double x : axis) values.push_back(std::hypot(x, y));
  }
  const std::vector<ContourLine> lines = contour_lines(axis, axis, values, 0.5);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].closed);
  for (const glm::dvec2& point : lines[0].points) {
    CHECK(glm::length(point) == Approx(0.5).margin(2e-4));  // h^2 / (8 r) of a chord is 1e-4
  }
}

TEST_CASE("contours of a plane are straight lines, exact and in one piece", "[format][contour]") {
  const std::vector<double> x = {0, 1, 2, 5};
  const std::vector<double> y = {0, 1, 4};
  std::vector<double> values;
  for (const double v : y) {
    for (const double u : x) values.push_back(2 * u + v);
  }
  const std::vector<ContourLine> lines = contour_lines(x, y, values, 3.5);
  REQUIRE(lines.size() == 1);
  CHECK_FALSE(lines[0].closed);
  for (const glm::dvec2& p : lines[0].points) CHECK(2 * p.x + p.y == Approx(3.5));
  CHECK(contour_lines(x, y, values, 100).empty());
}

TEST_CASE("saddles and holes interrupt contours, and never join separate ones",
          "[format][contour]") {
  const std::vector<double> axis = {0, 1};
  CHECK(contour_lines(axis, axis, std::vector<double>{1, 0, 0, 1}, 0.4).size() == 2);
  const double nan = std::nan("");
  CHECK(contour_lines(axis, axis, std::vector<double>{1, 0, nan, 1}, 0.5).empty());
  // Around a peak next to a hole the line is open.
  std::vector<double> values(25, 0);
  values[12] = 1;
  const std::vector<double> five = {0, 1, 2, 3, 4};
  CHECK(contour_lines(five, five, values, 0.5).at(0).closed);
  values[0] = values[6] = nan;
  CHECK_FALSE(contour_lines(five, five, values, 0.5).at(0).closed);
}

TEST_CASE("ticks lie at round numbers within the axis", "[format][axis]") {
  const auto labels = [](const std::vector<AxisTick>& ticks) {
    std::string out;
    for (const AxisTick& tick : ticks) {
      if (!tick.label.empty()) out += (out.empty() ? "" : " ") + tick.label;
    }
    return out;
  };
  CHECK(labels(linear_ticks(0, 10, 5)) == "0 2 4 6 8 10");
  CHECK(labels(linear_ticks(-0.31, 0.3, 6)) == "−0.3 −0.2 −0.1 0.0 0.1 0.2 0.3");
  CHECK(labels(linear_ticks(0, 0.7, 7)) == "0.0 0.1 0.2 0.3 0.4 0.5 0.6 0.7");
  CHECK(labels(log_ticks(0.01, 100)) == "0.01 0.1 1 10 100");
  CHECK(labels(log_ticks(1, 50)) == "1 2 5 10 20 50");
  CHECK(labels(log_ticks(1e-6, 1e-2)) == "10⁻⁶ 10⁻⁵ 10⁻⁴ 10⁻³ 10⁻²");
  CHECK(log_ticks(1, 1000).size() == 28);  // 2..9 of three decades besides
  for (const double high : {1e-9, 0.3, 1.0, 7.0, 1e4, 1e12}) {
    for (int about = 1; about < 12; ++about) {
      const std::vector<AxisTick> ticks = linear_ticks(0, high, about);
      CHECK(ticks.size() >= 1);
      CHECK(ticks.size() <= 2 * static_cast<size_t>(about) + 2);
      CHECK(ticks.back().value <= high * (1 + 1e-5));
    }
    CHECK(round_down_125(high) <= high * (1 + 1e-5));
    CHECK(round_up_125(high) >= high * (1 - 1e-5));
  }
  CHECK(log_ticks(1e-300, 1e300).size() < 30);
}
