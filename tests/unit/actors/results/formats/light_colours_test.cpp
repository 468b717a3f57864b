#include "actors/results/formats/light_colours.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace luxodus;

namespace {

/// OKLab lightness of an sRGB colour, implemented independently from the published matrices.
double lightness(const LightColour& rgb) {
  const auto linear = [](uint8_t v) {
    const double c = v / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double r = linear(rgb[0]), g = linear(rgb[1]), b = linear(rgb[2]);
  return 0.2104542553 * std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b) +
         0.7936177850 * std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b) -
         0.0040720468 * std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
}

/// The map in the page of the live view: 256 colours, 16 on a line.
std::string module_of_the_page() {
  std::string out = fmt::format(
      "// The colour map of actors/results/formats/light_colours.hpp for the live view's page. A "
      "test of\n"
      "// that room compares the two, and says how to regenerate this one.\n\n"
      "/** Ends of the scale of luminance [cd/m2]. */\n"
      "export const scaleLow = {:g};\nexport const scaleHigh = {:g};\n\n"
      "/** 256 colours from the lower end to the upper one, as rrggbb. */\n"
      "export const scaleColours = [\n",
      luminance_scale.low, luminance_scale.high);
  for (int i = 0; i < 256; ++i) {
    const LightColour c = light_colour(i / 255.0);
    out += fmt::format("{}{:02x}{:02x}{:02x}{}", i % 13 == 0 ? "  '" : "", c[0], c[1], c[2],
                       i % 13 == 12 || i == 255 ? "',\n" : " ");
  }
  return out + "].join(' ').split(' ');\n";
}

}  // namespace

TEST_CASE("the lightness of the colour map rises evenly, so that it works in grey",
          "[output][colour]") {
  for (int i = 0; i <= 100; ++i) {
    CHECK(lightness(light_colour(i / 100.0)) == Approx(0.10 + 0.87 * i / 100.0).margin(0.015));
  }
  CHECK(light_colour(-1) == light_colour(0));
  CHECK(light_colour(2) == light_colour(1));
  CHECK(light_colour(std::nan("")) == light_colour(0));
}

TEST_CASE("1 lx has one colour, and every decade has the same length", "[output][colour]") {
  CHECK(illuminance_scale.place(0.1) == Approx(0).margin(1e-12));
  CHECK(illuminance_scale.place(1) == Approx(1.0 / 3));
  CHECK(illuminance_scale.place(100) == Approx(1));
  CHECK(luminance_scale.place(1) == Approx(0.5));
  CHECK(colour_of_illuminance(1) == light_colour(1.0 / 3));
  for (const double none : {0.0, -1.0, std::nan("")})
    CHECK(colour_of_illuminance(none) == light_colour(0));
}

TEST_CASE("the page of the live view has the same colours", "[output][colour]") {
  const auto file =
      std::filesystem::path(LUX_SOURCE_DIR) / "actors/apps/view/page/src/light/colour_map.js";
  std::ifstream in(file);
  const std::string held{std::istreambuf_iterator<char>(in), {}};
  const std::string wanted = module_of_the_page();
  if (held != wanted) {
    const auto made = std::filesystem::temp_directory_path() / "colour_map.js";
    std::ofstream(made) << wanted;
    FAIL(file.string() + " differs from the map: copy " + made.string() + " over it");
  }
  CHECK(held.size() > 1000);
}
